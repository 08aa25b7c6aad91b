// SPDX-License-Identifier: MIT
// The compiled half of the Python module dch: numpy arrays in and out. The Python sources beside it read
// arguments.
#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/version.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace {

namespace py = pybind11;

template <class Exception>
py::object add_error(py::module_& m, const char* name, const py::object& base, const char* text) {
  auto& error = py::register_exception<Exception>(m, name, base);
  error.attr("__doc__") = text;
  error.attr("__module__") = "dch";
  return error;
}

/// Errors of the library, the more special ones last, which are tried first.
void add_errors(py::module_& m) {
  const auto value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  const py::object invalid =
      add_error<dch::Error>(m, "InvalidParameter", value_error,
                            "An argument that does not fit; the message names value, limit and remedy.");
  add_error<dch::InvalidBox>(m, "InvalidBox", invalid, "A cell that spans no volume, or is too skewed.");
  add_error<dch::InvalidPosition>(m, "InvalidPosition", invalid,
                                  "A coordinate that is not finite, or too far away.");
  add_error<dch::CutoffTooLarge>(
      m, "CutoffTooLarge", invalid,
      "A cutoff beyond half the smallest height of the cell, where that is the limit.");
  // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11's signature
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const dch::TooManyPairs& error) {
      PyErr_SetString(PyExc_MemoryError, error.what());
    } catch (const dch::python::NotEnoughMemory& error) {
      PyErr_SetString(PyExc_MemoryError, error.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.attr("version") = DCH_VERSION;
  add_errors(m);
  dch::python::bind_chains(m);
  dch::python::bind_crossings(m);
  dch::python::bind_hierarchy(m);
  dch::python::bind_pairs(m);
  dch::python::bind_queries(m);
}

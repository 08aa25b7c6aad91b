// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/engines/pair_columns.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch::python {

namespace py = pybind11;

/// Contiguous arrays; the Python sources convert what callers hand in. None is converted here.
using Doubles = py::array_t<double, py::array::c_style>;
using Ints = py::array_t<std::int32_t, py::array::c_style>;

/// A view of an array of n x 3. @throws InvalidParameter for another shape.
Span<const Vec3> points_of(const Doubles& array);
/// A view of an array of m x 2. @throws InvalidParameter for another shape.
Span<const IndexPair> index_pairs_of(const Ints& array);
Span<const double> numbers_of(const std::optional<Doubles>& array);
Span<const std::int32_t> numbers_of(const std::optional<Ints>& array);

/// The box of a cell (rows are its vectors) that is periodic along some of them. Vectors along open axes have
/// no meaning, so they may be zero, or depend on others.
/// @throws InvalidBox as Box::triclinic
Box box_of(const Doubles& cell, std::array<bool, 3> periodic);

/// box_of() for who asks again and again, mostly about the same cell: a box is made where the cell is another
/// one.
class LastBox {
 public:
  const Box& of(const Doubles& cell, std::array<bool, 3> periodic);
  const Box& last() const { return box_; }

 private:
  Box box_;
  std::array<double, 9> cell_{};
  std::array<bool, 3> periodic_{false, false, false};
};

/// Whether it is a contiguous array of float64 of so many rows (any number: -1) and three columns, as numpy
/// makes them, in the order of this machine's bytes.
bool is_plain(py::handle value, py::ssize_t rows);
bool are_finite(const Doubles& array);

/// A symmetric matrix of cutoffs. @throws InvalidParameter as TypeCutoffs
TypeCutoffs cutoffs_of(const Doubles& matrix);

/// What deletes an object when the last array over its elements is gone.
template <class T>
py::capsule owner_of(std::unique_ptr<T> owned) {
  py::capsule owner(owned.get(), [](void* p) { delete static_cast<T*>(p); });
  owned.release();
  return owner;
}

/// An array over the elements of a vector, which lives as long as the array does.
template <class T>
py::array array_of(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape = {static_cast<py::ssize_t>(values.size())};
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const T* const data = owned->data();
  const py::capsule owner = owner_of(std::move(owned));
  return py::array_t<T>(std::move(shape), data, owner);
}

/// An array over the elements of a vector that somebody else owns.
template <class T>
py::array array_in(const std::vector<T>& values, const py::capsule& owner) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data(), owner);
}

/// Bytes that may be taken before the machine swaps, the container is full, or the process is at its limit
/// (ulimit -v); a large number where nobody says.
double available_memory();

/// available_memory() as it was a tenth of a second ago or less. To ask the system takes as long as an update
/// of 10,000 particles.
class RecentMemory {
 public:
  double available();

 private:
  double bytes_ = 0;
  std::chrono::steady_clock::time_point until_{};
};

/// A MemoryError of Python, before memory is taken.
class NotEnoughMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws NotEnoughMemory if things take more than there is.
void check_memory(double things, double bytes_each, const char* what, const char* remedy);

/// Whether all pairs of so many particles take less than half of what is free: nobody needs to know then how
/// many are near.
bool fits_if_all_are_near(std::size_t particles, double bytes_per_pair);
bool fits_if_all_are_near(std::size_t particles, double bytes_per_pair, RecentMemory& memory);

/// Which arrays of pairs are asked for.
struct PairOutput {
  std::string quantities;             ///< letters of ijdDS, each at most once
  bool is_single = false;             ///< d and D are float32, else float64
  std::optional<py::tuple> arrays{};  ///< given ones, one for each letter, in place of new ones

  /// That new arrays take.
  double bytes_per_pair() const;
};

/// Arrays of some of i, j, d, D and S.
class PairArrays {
 public:
  /// @throws NotEnoughMemory if the machine has not that much memory; InvalidParameter for given arrays of
  ///   another type or with fewer rows than pairs.
  PairArrays(const PairOutput& output, std::int64_t pairs);

  const PairColumns& columns() const { return columns_; }
  /// Leaves out those behind. Of given arrays the beginnings stay, as views.
  void shorten(std::int64_t pairs);
  /// One for each letter.
  py::tuple tuple() const { return arrays_; }

 private:
  template <class T, class Element>
  void column(std::size_t k, const PairOutput& output, std::int64_t pairs, Element*& elements);

  py::tuple arrays_;
  bool are_given_ = false;
  PairColumns columns_;
};

}  // namespace dch::python

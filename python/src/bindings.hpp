// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

/// What each source adds to the module.
namespace dch::python {

void bind_chains(pybind11::module_& m);
void bind_crossings(pybind11::module_& m);
void bind_hierarchy(pybind11::module_& m);
void bind_pairs(pybind11::module_& m);
void bind_queries(pybind11::module_& m);

}  // namespace dch::python

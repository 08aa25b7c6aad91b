// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "arrays.hpp"

namespace dch::python {

/// A number or several of each event, one row an event.
template <class T, std::size_t kColumns, class Events, class Row>
py::array rows_of(const Events& events, const Row& row) {
  std::vector<T> values;
  values.reserve(kColumns * events.size());
  for (const auto& event : events) {
    const std::array<T, kColumns> numbers = row(event);
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(events.size())};
  if (kColumns > 1) shape.push_back(static_cast<py::ssize_t>(kColumns));
  return array_of(std::move(values), std::move(shape));
}

}  // namespace dch::python

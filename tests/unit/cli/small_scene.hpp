// SPDX-License-Identifier: MIT
#pragma once

#include <numeric>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/trajectory/frame.hpp>

#include "random.hpp"

namespace dch::cli {

/// n random atoms in a periodic cube of side 10, ids 101, 102, ...
inline trajectory::Frame random_frame(std::size_t n, std::uint64_t seed = 7) {
  trajectory::Frame frame;
  frame.box = Box::orthorhombic({10, 10, 10});
  scenes::Random random(seed);
  for (std::size_t k = 0; k < n; ++k) frame.positions.push_back(random.in_cube(5));
  frame.ids.resize(n);
  std::iota(frame.ids.begin(), frame.ids.end(), 101);
  return frame;
}

}  // namespace dch::cli

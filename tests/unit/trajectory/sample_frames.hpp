// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory::test {

/// A small frame with everything in it; k makes it differ from others.
inline Frame sample_frame(int k, const Box& box) {
  Frame frame;
  frame.step = 100 * k;
  frame.time = 0.1 * k;
  frame.box = box;
  frame.positions = {{0.1 + k, 1.0 / 3, -2e-7}, {1e5, -0.0, 2.5}, {k / 7.0, 3, 4}};
  frame.ids = {2, 3, 11};
  frame.types = {1, 1, 4};
  frame.molecules = {5, 5, 0};
  frame.images = {{0, k, -1}, {1, 0, 0}, {0, 0, 2}};
  return frame;
}

inline void expect_equal(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.box, b.box);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.ids, b.ids);
  EXPECT_EQ(a.types, b.types);
  EXPECT_EQ(a.molecules, b.molecules);
  EXPECT_EQ(a.images, b.images);
}

}  // namespace dch::trajectory::test

// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/lists/list_params.hpp>

#include "special_numbers.hpp"

namespace dch {
namespace {

TEST(TypeCutoffs, OneForAll) {
  const TypeCutoffs cutoffs(2.5);
  EXPECT_EQ(cutoffs.types(), 1);
  EXPECT_EQ(cutoffs(0, 0), 2.5);
  EXPECT_EQ(cutoffs.largest(), 2.5);
}

TEST(TypeCutoffs, SymmetricMatrix) {
  const TypeCutoffs cutoffs(2, {1, 3, 3, 0});
  EXPECT_EQ(cutoffs(0, 1), 3);
  EXPECT_EQ(cutoffs(1, 1), 0);
  EXPECT_EQ(cutoffs.largest(), 3);
}

TEST(TypeCutoffs, BadMatricesAreRefused) {
  EXPECT_THROW(TypeCutoffs(0.0), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(-1.0), InvalidParameter);
  EXPECT_THROW(TypeCutoffs{kNaN}, InvalidParameter);
  EXPECT_THROW(TypeCutoffs{kInfinity}, InvalidParameter);
  EXPECT_THROW(TypeCutoffs(0, {}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(-1, {1}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(2, {1, 1, 1}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(2, {1, 1, 1, 1, 1}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(2, {1, 2, 3, 1}), InvalidParameter) << "not symmetric";
  EXPECT_THROW(TypeCutoffs(2, {1, -2, -2, 1}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(2, {1, kNaN, kNaN, 1}), InvalidParameter);
  EXPECT_THROW(TypeCutoffs(2, {0, 0, 0, 0}), InvalidParameter);
}

}  // namespace
}  // namespace dch

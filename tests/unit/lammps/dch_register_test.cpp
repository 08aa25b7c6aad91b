// SPDX-License-Identifier: GPL-2.0-or-later
#include "dch_register.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lmptype.h>
#include <string>

namespace {

TEST(DchRegister, RefusesAnythingButTheVersionItWasBuiltFor) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(dch_register(nullptr), 1);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("were built for LAMMPS version " + std::to_string(DCH_LAMMPS_VERSION) +
                                 ", but this is version 0; build them against the headers of this LAMMPS"));
}

TEST(DchRegister, RefusesIdsOfAnotherSize) {
  constexpr int known = sizeof(LAMMPS_NS::tagint), other = known == 4 ? 8 : 4;
  testing::internal::CaptureStderr();
  EXPECT_TRUE(dch::lammps::fits_ids_of(known));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  EXPECT_FALSE(dch::lammps::fits_ids_of(other));
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AllOf(testing::HasSubstr("built for LAMMPS with atom IDs of " + std::to_string(known)),
                             testing::HasSubstr("this has IDs of " + std::to_string(other) + " bytes")));
}

}  // namespace

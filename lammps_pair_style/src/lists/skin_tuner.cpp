// SPDX-License-Identifier: GPL-2.0-or-later
#include "skin_tuner.h"

#include <algorithm>
#include <cmath>

namespace dch::lammps {
namespace {

constexpr double kRatio = 0.8;     ///< of one skin to the one before
constexpr int kTrials = 10;        ///< down to 0.13 of the largest
constexpr int kSlower = 2;         ///< trials in a row that end the search
constexpr std::size_t kLists = 5;  ///< a trial; the median counts, for others use the machine too

}  // namespace

double SkinTuner::skin_of(int trial) const { return largest_ * std::pow(kRatio, trial); }

void SkinTuner::observe(double seconds, std::int64_t steps) {
  if (settled_ || steps <= 0) return;
  per_step_.push_back(seconds / static_cast<double>(steps));
  if (per_step_.size() == kLists) conclude();
}

void SkinTuner::conclude() {
  const auto middle = per_step_.begin() + kLists / 2;
  std::nth_element(per_step_.begin(), middle, per_step_.end());
  if (trying_ == 0 || *middle < least_) {
    least_ = *middle;
    best_ = trying_;
  }
  per_step_.clear();
  ++trying_;
  settled_ = trying_ == kTrials || trying_ - best_ > kSlower;
}

}  // namespace dch::lammps

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace dch::lammps {

/// Looks for the skin with which a step takes the least time: a smaller one means fewer pairs and more lists.
///
/// Skins are tried from the largest downwards, each a fifth smaller than the one before, for a few lists
/// each; after two in a row that were slower than the best one so far, that one is kept.
class SkinTuner {
 public:
  /// @param largest what the lists are complete for at most: the skin of the input script, > 0 [length]
  explicit SkinTuner(double largest) : largest_(largest) {}

  double skin() const { return skin_of(settled_ ? best_ : trying_); }  ///< for the next list [length]
  double largest() const { return largest_; }
  bool settled() const { return settled_; }
  /// What the list that was made with skin() has cost, from its build to that of the next. Those of no steps
  /// do not count.
  void observe(double seconds, std::int64_t steps);

 private:
  double skin_of(int trial) const;
  void conclude();

  double largest_;
  int trying_ = 0, best_ = 0;
  double least_ = 0;              ///< seconds a step with the best skin
  std::vector<double> per_step_;  ///< of the lists with the present one
  bool settled_ = false;
};

}  // namespace dch::lammps

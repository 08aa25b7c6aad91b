// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <pair.h>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

/// What a style writes to restart files before pairs of types.
std::string restart_settings(Pair& style);

/// What a pair style keeps to itself but writes to restart files: numbers for all pairs, then those of each
/// pair of types that has some.
class RestartNumbers {
 public:
  /// Reads those of these pairs of types, from 1, a <= b, mixed ones too. Without a restart file.
  /// @param own  how many numbers a pair of types has
  /// @throws nothing, but error->one() for a style that writes something else
  RestartNumbers(Pair& style, const std::string& name, int types, int own,
                 const std::vector<std::pair<int, int>>& pairs, Error& error);

  const double* all() const { return all_.data(); }
  /// In the order in which pairs were given.
  const double* of_pair(std::size_t k) const { return of_pairs_[k].data(); }

 private:
  std::vector<double> all_;
  std::vector<std::vector<double>> of_pairs_;
};

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>

#include "charged_tree.hpp"
#include "expansions.hpp"
#include "far_descent.hpp"

namespace dch::detail {

struct SumCounts {
  std::int64_t far_pairs = 0, near_pairs = 0, looked_at = 0;
};

/// A target with what its parent left. Tasks are the same on any number of threads.
struct SumTask {
  std::int32_t target = 0;
  std::vector<SumSource> sources;
  double error = 0;           ///< of what its parents took, at most
  std::vector<double> local;  ///< expansion about the target's center of what its parents took
};

/// Potentials by descent from the root to targets, in units of the tree. A target takes some of the sources
/// that its parent left by expansions into its own local one, which it hands on to its children; what is left
/// at the bottom is summed charge by charge.
class PotentialSums {
 public:
  PotentialSums(const ChargedTree& tree, const Expansions& expansions);

  /// Sums anew. Returns the largest bound on the error at a point over its potential by absolute charges.
  double add_up(const SumScene& scene, Executor* executor);

  /// Of the last sum.
  const SumCounts& counts() const { return counts_; }
  /// By place in the tree.
  const std::vector<double>& potentials() const { return potentials_; }

 private:
  class Worker;

  const ChargedTree& tree_;
  const Expansions& expansions_;
  std::vector<Expansions> lower_;          ///< by order
  std::vector<TranslationTables> tables_;  ///< of them
  std::vector<double> moments_;            ///< short ones, by node
  std::vector<double> potentials_;
  SumCounts counts_;
};

}  // namespace dch::detail

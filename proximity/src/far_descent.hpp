// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>

#include "charged_tree.hpp"
#include "truncation.hpp"

namespace dch::detail {

/// A node in one of its images.
struct SumSource {
  std::int32_t node = 0, image = 0;
};

struct FarSource {
  SumSource source;
  Vec3 from;     ///< the center of the target, from that of the source
  double apart;  ///< the length of that
  int order;     ///< of expansions
};

/// How a target takes its sources.
struct Interactions {
  std::vector<FarSource> far;      ///< by expansions
  std::vector<SumSource> near;     ///< charge by charge, if it is at the bottom
  std::vector<SumSource> rest;     ///< left to its children
  std::vector<SumSource> waiting;  ///< scratch
  std::int64_t looked_at = 0;
};

/// What sums are made of.
struct SumScene {
  const ChargedTree& tree;
  const std::vector<Vec3>& images;  ///< displacements, in units of the tree; the first one is 0
  const Truncation& truncation;
  const std::vector<double>& least;  ///< of least_potentials()
  double most = 0;                   ///< of that, which all errors together may have
  double share = 0;                  ///< the same of the error of one pair
};

/// The root in all images.
std::vector<SumSource> root_sources(const SumScene& scene);

/// For each node, what the sum over absolute charges is at least at all of its points.
std::vector<double> least_potentials(const ChargedTree& tree, const std::vector<Vec3>& images,
                                     const Truncation& truncation);

/// Decides for one target, given the sources that its parent left. A pair of nodes is far if the error that
/// it adds is a small enough share of the potential that the target is known to have.
/// @param error of the potentials at most, by what was taken by expansions; grows
void take_sources(const SumScene& scene, std::int32_t target, Span<const SumSource> sources, double& error,
                  Interactions& result);

}  // namespace dch::detail

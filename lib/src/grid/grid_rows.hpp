// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "grid/cell_candidates.hpp"
#include "grid/cell_layer.hpp"
#include "grid/rounded_particles.hpp"
#include "lists/pair_filter.hpp"
#include "lists/row_parts.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// What lists are made of, the same for all of them.
struct GridScene {
  Span<const Vec3> positions;  ///< as given
  const Box& box;
  /// Those of the smallest cutoffs first. The rows of one hold its pairs with those before it.
  std::vector<CellLayer*> layers;
  /// Largest list radius of the points of two layers, row-major; 0 where they have no pairs [length].
  std::vector<double> reach;
  double error;  ///< how far the distance of two positions may be from their pair distance [length]
  Executor* executor;

  double reach_of(std::size_t a, std::size_t b) const { return reach[a * layers.size() + b]; }
};

/// Writes neighbor lists from points in cells. Each pair of points is found in one image, the nearest: list
/// radii are below half the box. That a cell may meet another one in several images is no harm: each pair of
/// images is met once.
class GridRows {
 public:
  /// Finds all pairs that each filter accepts, as FindRows says.
  void find(const GridScene& scene, const std::vector<const PairFilter*>& filters,
            const std::vector<NeighborList*>& out);
  /// The same for one filter in pieces, each of which use() gets on the thread that found it.
  void find_in_pieces(const GridScene& scene, const PairFilter& filter,
                      const std::function<void(const NeighborList&)>& use);
  std::size_t memory_bytes() const { return parts_.memory_bytes() + rounded_.memory_bytes(); }

 private:
  /// Called when the rows of a cell have been appended to lists, one for each request.
  using Appended = std::function<void(const std::vector<RowRequest>& requests, NeighborList* lists)>;
  void append(const GridScene& scene, const std::vector<const PairFilter*>& filters,
              const std::vector<NeighborList*>& out, const Appended& appended);

  void round_layers(const GridScene& scene, std::size_t rows, const CellRounding& rounding,
                    const ParticleLabels& labels);

  RowParts<CellCandidates> parts_;
  RoundedParticles rounded_;
};

}  // namespace dch::detail

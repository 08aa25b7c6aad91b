// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/list_maker.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/trajectory/frame.hpp>

namespace dch::cli {

/// What is shown of a level of the hierarchy.
struct ViewedLevel {
  double covering_radius = 0;         ///< R_i: parents are within it [length]
  double edge_threshold = 0;          ///< rho_i [length]
  std::vector<std::int32_t> nodes;    ///< atoms that stand in the level, ascending
  std::vector<std::int32_t> parents;  ///< by node: place in the nodes of the next level; -1 for a root
  NeighborList edges;  ///< of G_c, by places in nodes; none for level 0, where contacts stand for them
};

/// What is shown of a frame.
struct ViewedFrame {
  std::int64_t frame = 0;  ///< index in the file, from 0
  std::int64_t step = 0;
  std::optional<double> time;
  Box box;
  std::vector<Vec3> positions;  ///< inside the reduced cell
  NeighborList contacts;        ///< pairs within the cutoff, without the skin
  std::vector<ViewedLevel> levels;
};

/// A hierarchy that is kept up from frame to frame as that of a replay, but repaired in each frame, so that
/// what is seen of it holds for the frame; of any engine's replay.
class ViewedHierarchy {
 public:
  /// @throws InvalidParameter for a radius out of range.
  explicit ViewedHierarchy(const HierarchyParams& params) : hierarchy_(params) {}

  /// @param params of the list; its skin is left out
  /// @throws as Hierarchy::build
  const ViewedFrame& take(const trajectory::Frame& frame, std::int64_t index, const ListParams& params);

 private:
  void update(const trajectory::Frame& frame);
  void read_nodes(const HierarchyView& view);
  void read_links(const HierarchyView& view);

  Hierarchy hierarchy_;
  ListMaker lists_;
  std::vector<std::int64_t> ids_;     ///< of the atoms in hierarchy_
  std::vector<std::int32_t> places_;  ///< by atom, its place in a level
  ViewedFrame shown_;
};

}  // namespace dch::cli

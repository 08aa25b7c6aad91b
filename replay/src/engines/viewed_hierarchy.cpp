// SPDX-License-Identifier: MIT
#include "engines/viewed_hierarchy.hpp"

#include <cstddef>

namespace dch::cli {

const ViewedFrame& ViewedHierarchy::take(const trajectory::Frame& frame, std::int64_t index,
                                         const ListParams& params) {
  update(frame);
  const HierarchyView view = hierarchy_.view();
  shown_.frame = index;
  shown_.step = frame.step;
  shown_.time = frame.time;
  shown_.box = frame.box;
  shown_.positions.clear();
  for (const Vec3& position : frame.positions) shown_.positions.push_back(frame.box.wrap(position));
  ListParams contacts = params;
  contacts.skin = 0;
  contacts.kind = ListKind::half;
  lists_.list(view, contacts, shown_.contacts);
  read_nodes(view);
  read_links(view);
  return shown_;
}

void ViewedHierarchy::update(const trajectory::Frame& frame) {
  const bool same_atoms = frame.ids == ids_ && !ids_.empty();
  ids_.clear();  // until it is known that the hierarchy holds them
  if (same_atoms) {
    hierarchy_.update(frame.positions, frame.box);
    hierarchy_.repair();
  } else {
    hierarchy_.build(frame.positions, frame.box);
  }
  ids_ = frame.ids;
}

void ViewedHierarchy::read_nodes(const HierarchyView& view) {
  const auto levels = static_cast<std::size_t>(view.levels());
  shown_.levels.assign(levels, {});
  for (std::size_t i = 0; i < levels; ++i) {
    const LevelInfo info = view.level(static_cast<int>(i));
    shown_.levels[i].covering_radius = info.covering_radius;
    shown_.levels[i].edge_threshold = info.edge_threshold;
  }
  const auto atoms = static_cast<std::int32_t>(view.size());
  for (std::int32_t atom = 0; atom < atoms; ++atom) {
    const auto top = static_cast<std::size_t>(view.top_level(atom));
    for (std::size_t i = 0; i <= top; ++i) shown_.levels[i].nodes.push_back(atom);
  }
}

/// From the highest level down: places_ is that of the level above for parents, then that of the level.
void ViewedHierarchy::read_links(const HierarchyView& view) {
  places_.assign(view.size(), -1);
  for (std::size_t k = shown_.levels.size(); k-- > 0;) {
    const int i = static_cast<int>(k);
    ViewedLevel& level = shown_.levels[k];
    for (const std::int32_t node : level.nodes) {
      const std::int32_t parent = view.parent(node, i);
      level.parents.push_back(parent < 0 ? -1 : places_[static_cast<std::size_t>(parent)]);
    }
    for (std::size_t place = 0; place < level.nodes.size(); ++place)
      places_[static_cast<std::size_t>(level.nodes[place])] = static_cast<std::int32_t>(place);
    if (i == 0) return;
    for (const std::int32_t node : level.nodes) {
      for (const std::int32_t neighbor : view.neighbors(node, i))
        if (neighbor > node) level.edges.j.push_back(places_[static_cast<std::size_t>(neighbor)]);
      level.edges.first.push_back(static_cast<std::int64_t>(level.edges.j.size()));
    }
  }
}

}  // namespace dch::cli

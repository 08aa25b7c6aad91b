// SPDX-License-Identifier: MIT
#include "tree_rows.hpp"

#include <cstddef>
#include <utility>

#include <dch/base/index_count.hpp>

namespace dch::detail {

std::int32_t TreeRows::append(std::int32_t parent) {
  const std::int32_t children = node(parent).children, room = net(parent).room;
  if (children == room) {
    const std::int32_t more = children + children / 2 + 1;
    const std::int32_t row = take_row(more), before = node(parent).first_child;
    for (std::int32_t k = 0; k < children; ++k) move(before + k, row + k);
    give_row(before, room);
    node(parent).first_child = row;
    net(parent).room = more;
  }
  const std::int32_t added = node(parent).first_child + node(parent).children++;
  node(added) = {};
  node(added).parent = parent;
  net(added) = {};
  ++tree_.alive_;
  return added;
}

void TreeRows::erase(std::int32_t erased) {
  PointTree::Node& parent = node(node(erased).parent);
  const std::int32_t last = parent.first_child + --parent.children;
  if (erased != last) move(last, erased);
  node(last) = {};
  --tree_.alive_;
}

std::int32_t TreeRows::push_down(std::int32_t above) {
  const std::int32_t row = take_row(2), parent = node(above).parent;
  const TreeNet before = net(above);
  move(above, row);
  node(above) = node(row);
  node(above).parent = parent;
  node(above).first_child = row;
  node(above).children = 1;
  net(above) = {before.site, 0, before.moved, 0, 2};
  node(row).parent = above;
  ++tree_.alive_;
  return row;
}

void TreeRows::pull_up(std::int32_t above) {
  const std::int32_t parent = node(above).parent, row = node(above).first_child;
  const TreeNet before = net(above);
  move(row, above);
  node(above).parent = parent;
  net(above).site = before.site;
  net(above).moved += before.moved;
  give_row(row, before.room);
  --tree_.alive_;
}

std::int32_t TreeRows::take_row(std::int32_t room) {
  auto& free = tree_.free_rows_;
  if (static_cast<std::size_t>(room) < free.size()) {
    auto& rows = free[static_cast<std::size_t>(room)];
    if (!rows.empty()) {
      const std::int32_t first = rows.back();
      rows.pop_back();
      return first;
    }
  }
  const auto first = tree_.nodes_.size();
  const std::size_t places = first + static_cast<std::size_t>(room);
  index_count(static_cast<std::int64_t>(places), "places for nodes in a tree", "take fewer points");
  tree_.nodes_.resize(places);
  tree_.nets_.resize(places);
  return static_cast<std::int32_t>(first);
}

void TreeRows::give_row(std::int32_t first, std::int32_t room) {
  const auto length = static_cast<std::size_t>(room);
  if (tree_.free_rows_.size() <= length) tree_.free_rows_.resize(length + 1);
  tree_.free_rows_[length].push_back(first);
}

void TreeRows::move(std::int32_t from, std::int32_t to) {
  node(to) = std::exchange(node(from), {});
  net(to) = net(from);
  const PointTree::Node& moved = node(to);
  if (moved.children == 0) tree_.node_of_[static_cast<std::size_t>(moved.representative)] = to;
  for (std::int32_t k = 0; k < moved.children; ++k) node(moved.first_child + k).parent = to;
}

void TreeRows::close_gaps() {
  constexpr std::size_t kFew = 64;
  const auto alive = static_cast<std::size_t>(tree_.alive_);
  if (tree_.nodes_.size() <= 2 * alive + kFew) return;
  std::vector<PointTree::Node> nodes{tree_.nodes_[0]};
  std::vector<TreeNet> nets{tree_.nets_[0]};
  nodes.reserve(alive);
  nets.reserve(alive);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    PointTree::Node& parent = nodes[k];
    const auto before = static_cast<std::size_t>(parent.first_child);
    if (parent.children == 0)
      tree_.node_of_[static_cast<std::size_t>(parent.representative)] = static_cast<std::int32_t>(k);
    parent.first_child = parent.children > 0 ? static_cast<std::int32_t>(nodes.size()) : 0;
    nets[k].room = parent.children;
    const auto children = static_cast<std::size_t>(parent.children);
    for (std::size_t c = before; c < before + children; ++c) {  // there is room: `parent` stays
      nodes.push_back(tree_.nodes_[c]);
      nodes.back().parent = static_cast<std::int32_t>(k);
      nets.push_back(tree_.nets_[c]);
    }
  }
  tree_.nodes_ = std::move(nodes);
  tree_.nets_ = std::move(nets);
  tree_.free_rows_.clear();
}

}  // namespace dch::detail

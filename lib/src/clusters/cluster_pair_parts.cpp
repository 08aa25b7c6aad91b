// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: the rows, cut into parts for the threads of a force kernel.
#include <algorithm>
#include <utility>

#include "clusters/cluster_pair_finder.hpp"

namespace dch::detail {
namespace {

/// Clusters of a part, at least, and the most parts. In a Lennard-Jones melt the least part names nearly as
/// many clusters of other parts; with smaller ones that grows, and with it what it takes to sum up.
constexpr std::int32_t kClustersPerPart = 1024, kMaxParts = 32;

}  // namespace

/// Shifts stand in the order of the nodes that they lead from, hence of their clusters, and name all nodes
/// that these meet.
void ClusterPairFinder::cut_into_parts(ClusterPairs& out) {
  out.parts.clear();
  out.ranges.clear();
  part_of_node_.assign(nodes_.size(), kNone);
  out.is_named_before.assign(nodes_.size(), 0);
  const std::int32_t wanted = std::max(kClustersPerPart, out.clusters() / kMaxParts);
  const auto first_of = [&](std::int64_t shift) {
    return nodes_[static_cast<std::size_t>(out.shift[static_cast<std::size_t>(shift)].from)].first;
  };
  const auto shifts = static_cast<std::int64_t>(out.shift.size());
  for (std::int64_t shift = 0; shift < shifts;) {
    const std::int32_t first = first_of(shift);
    std::int64_t end = shift;
    while (end < shifts && first_of(end) - first < wanted) ++end;
    out.parts.push_back({first, static_cast<std::int64_t>(out.ranges.size())});
    append_ranges({shift, end}, end < shifts ? first_of(end) : out.clusters(), out);
    shift = end;
  }
  out.parts.push_back({out.clusters(), static_cast<std::int64_t>(out.ranges.size())});
}

/// The clusters of the nodes that shifts of the last part lead to, from one cluster on.
void ClusterPairFinder::append_ranges(Shifts shifts, std::int32_t first_cluster, ClusterPairs& out) {
  const auto part = static_cast<std::int32_t>(out.parts.size());
  named_nodes_.clear();
  for (std::int64_t k = shifts.first; k < shifts.last; ++k) {
    const std::int32_t to = out.shift[static_cast<std::size_t>(k)].to;
    if (nodes_[static_cast<std::size_t>(to)].first < first_cluster) continue;
    std::int32_t& last_named_by = part_of_node_[static_cast<std::size_t>(to)];
    if (std::exchange(last_named_by, part) != part) named_nodes_.push_back(to);
  }
  std::sort(named_nodes_.begin(), named_nodes_.end());
  const std::size_t before = out.ranges.size();
  for (const std::int32_t k : named_nodes_) {
    const Node& node = nodes_[static_cast<std::size_t>(k)];
    const std::int32_t last = node.first + node.clusters;
    out.is_named_before[static_cast<std::size_t>(k)] = 1;
    if (out.ranges.size() > before && out.ranges.back().last == node.first) {
      out.ranges.back().last = last;
    } else {
      out.ranges.push_back({node.first, last});
    }
  }
}

}  // namespace dch::detail

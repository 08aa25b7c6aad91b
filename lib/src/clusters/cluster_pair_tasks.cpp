// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: the rows, cut into tasks for the threads of a force kernel.
#include <algorithm>
#include <utility>

#include "clusters/cluster_pair_finder.hpp"

namespace dch::detail {
namespace {

/// Clusters of a task, at least, and the most tasks. In a Lennard-Jones melt the least task names nearly as
/// many clusters of other tasks; with smaller ones that grows, and with it what it takes to sum up.
constexpr std::int32_t kClustersPerTask = 1024, kMaxTasks = 32;

}  // namespace

/// Shifts stand in the order of the nodes that they lead from, hence of their clusters, and name all nodes
/// that these meet.
void ClusterPairFinder::cut_into_tasks(ClusterPairs& out) {
  out.tasks.clear();
  out.ranges.clear();
  task_of_node_.assign(nodes_.size(), kNone);
  out.has_earlier_contributions.assign(nodes_.size(), 0);
  const std::int32_t wanted = std::max(kClustersPerTask, out.clusters() / kMaxTasks);
  const auto first_of = [&](std::int64_t shift) {
    return nodes_[static_cast<std::size_t>(out.shift[static_cast<std::size_t>(shift)].from)].first;
  };
  const auto shifts = static_cast<std::int64_t>(out.shift.size());
  for (std::int64_t shift = 0; shift < shifts;) {
    const std::int32_t first = first_of(shift);
    std::int64_t end = shift;
    while (end < shifts && first_of(end) - first < wanted) ++end;
    out.tasks.push_back({first, static_cast<std::int64_t>(out.ranges.size())});
    append_ranges({shift, end}, end < shifts ? first_of(end) : out.clusters(), out);
    shift = end;
  }
  out.tasks.push_back({out.clusters(), static_cast<std::int64_t>(out.ranges.size())});
}

/// The clusters of the nodes that shifts of the last task lead to, from one cluster on.
void ClusterPairFinder::append_ranges(Shifts shifts, std::int32_t first_cluster, ClusterPairs& out) {
  const auto task = static_cast<std::int32_t>(out.tasks.size());
  named_nodes_.clear();
  for (std::int64_t k = shifts.first; k < shifts.last; ++k) {
    const std::int32_t to = out.shift[static_cast<std::size_t>(k)].to;
    if (nodes_[static_cast<std::size_t>(to)].first < first_cluster) continue;
    std::int32_t& last_named_by = task_of_node_[static_cast<std::size_t>(to)];
    if (std::exchange(last_named_by, task) != task) named_nodes_.push_back(to);
  }
  std::sort(named_nodes_.begin(), named_nodes_.end());
  const std::size_t before = out.ranges.size();
  for (const std::int32_t k : named_nodes_) {
    const Node& node = nodes_[static_cast<std::size_t>(k)];
    const std::int32_t last = node.first + node.clusters;
    out.has_earlier_contributions[static_cast<std::size_t>(k)] = 1;
    if (out.ranges.size() > before && out.ranges.back().last == node.first) {
      out.ranges.back().last = last;
    } else {
      out.ranges.push_back({node.first, last});
    }
  }
}

}  // namespace dch::detail

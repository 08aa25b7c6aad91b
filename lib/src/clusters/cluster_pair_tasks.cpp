// SPDX-License-Identifier: MIT
//
// ClusterPairFinder: the rows of all slices, side by side and cut into tasks for the threads of a force
// kernel.
#include <algorithm>
#include <vector>

#include "clusters/cluster_pair_finder.hpp"

namespace dch::detail {
namespace {

/// Clusters of a task, at least, and the most tasks. In a Lennard-Jones melt the least task names nearly as
/// many clusters of other tasks; with smaller ones that grows, and with it what it takes to sum up.
constexpr std::int32_t kClustersPerTask = 1024, kMaxTasks = 32;

}  // namespace

/// A slice that is alone has the memory of the pairs themselves while it is searched.
void ClusterPairFinder::swap_found(Slice& slice, ClusterPairs& out) {
  out.rows.swap(slice.rows);
  out.entries.swap(slice.entries);
  out.shift.swap(slice.shift);
}

void ClusterPairFinder::join(Executor* executor, ClusterPairs& out) {
  if (slices_.size() == 1) {
    slices_[0].entries.resize(slices_[0].written);
    swap_found(slices_[0], out);
  } else {
    append_slices(executor, out);
  }
  cut_into_tasks(out);
  out.rows.push_back({static_cast<std::int64_t>(out.entries.size()), 0, 0});
  out.split_clusters.clear();
  out.shift_vector.resize(out.shift.size());
  out.shift_in_units.resize(out.shift.size());
  out.has_shift_vectors = false;
}

/// Each slice goes to its place on the thread that comes to it, since all threads would wait for one that
/// copies them all. Arrays are not emptied before, so only what they grow by is set to zero.
void ClusterPairFinder::append_slices(Executor* executor, ClusterPairs& out) const {
  struct Begin {
    std::size_t rows = 0, entries = 0, shifts = 0;
  };
  std::vector<Begin> begin{{}};
  for (const Slice& slice : slices_) {
    const Begin& last = begin.back();
    begin.push_back(
        {last.rows + slice.rows.size(), last.entries + slice.written, last.shifts + slice.shift.size()});
  }
  shift_count(begin.back().shifts);
  out.rows.reserve(begin.back().rows + 1);  // and no more, which resize() alone may take
  out.entries.reserve(begin.back().entries);
  out.shift.reserve(begin.back().shifts);
  out.rows.resize(begin.back().rows);
  out.entries.resize(begin.back().entries);
  out.shift.resize(begin.back().shifts);
  executor->run(static_cast<int>(slices_.size()), [&](int p) {
    const Slice& slice = slices_[static_cast<std::size_t>(p)];
    const Begin& at = begin[static_cast<std::size_t>(p)];
    const auto first_entry = static_cast<std::int64_t>(at.entries);
    const auto first_shift = static_cast<std::int32_t>(at.shifts);
    for (std::size_t r = 0; r < slice.rows.size(); ++r) {
      const ClusterPairs::Row& row = slice.rows[r];
      out.rows[at.rows + r] = {first_entry + row.first, row.cluster, first_shift + row.first_shift};
    }
    std::copy_n(slice.entries.begin(), slice.written, out.entries.begin() + first_entry);
    std::copy(slice.shift.begin(), slice.shift.end(), out.shift.begin() + first_shift);
  });
}

/// Shifts stand in the order of the nodes that they lead from, hence of their clusters, and name all nodes
/// that these meet.
void ClusterPairFinder::cut_into_tasks(ClusterPairs& out) {
  const std::int32_t wanted = std::max(kClustersPerTask, out.clusters() / kMaxTasks);
  const auto first_of = [&](const ClusterPairs::Shift& shift) {
    return nodes_[static_cast<std::size_t>(shift.from)].first;
  };
  out.tasks.clear();
  out.ranges.clear();
  out.has_earlier_contributions.assign(nodes_.size(), 0);
  for (auto shift = out.shift.begin(); shift != out.shift.end();) {
    const std::int32_t first = first_of(*shift);
    // The first one of a node that is as far on as a task is to be long.
    const auto end = std::partition_point(shift, out.shift.end(), [&](const ClusterPairs::Shift& one) {
      return first_of(one) - first < wanted;
    });
    out.tasks.push_back({first, static_cast<std::int64_t>(out.ranges.size())});
    append_ranges({shift - out.shift.begin(), end - out.shift.begin()},
                  end == out.shift.end() ? static_cast<std::int32_t>(nodes_.size()) : end->from, out);
    shift = end;
  }
  out.tasks.push_back({out.clusters(), static_cast<std::int64_t>(out.ranges.size())});
}

/// The clusters of the nodes that shifts of the last task lead to, from one node on.
void ClusterPairFinder::append_ranges(Shifts shifts, std::int32_t first_node, ClusterPairs& out) {
  is_named_.assign(nodes_.size(), 0);
  for (std::int64_t s = shifts.first; s < shifts.last; ++s)
    is_named_[static_cast<std::size_t>(out.shift[static_cast<std::size_t>(s)].to)] = 1;
  const std::size_t before = out.ranges.size();
  for (auto k = static_cast<std::size_t>(first_node); k < nodes_.size(); ++k) {
    if (is_named_[k] == 0) continue;
    const Node& node = nodes_[k];
    const std::int32_t last = node.first + node.clusters;
    out.has_earlier_contributions[k] = 1;
    if (out.ranges.size() > before && out.ranges.back().last == node.first) {
      out.ranges.back().last = last;
    } else {
      out.ranges.push_back({node.first, last});
    }
  }
}

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/necklace/contacts.hpp>

namespace dch::necklace::detail {

/// A part of a search that needs no other: all pairs of a bead of one node and a bead of another that shares
/// none with it, or, if both are the same node, all pairs of its beads.
struct ContactTask {
  std::int32_t a, b;
  std::int32_t chain;      ///< that of both nodes; -1 if they are of different chains
  bool one_image = false;  ///< their beads can be in contact in one image alone, which is displaced by
  Vec3 shift{};
};

/// The beads that a task is about.
inline std::int32_t beads_of(const ChainTrees& trees, const ContactTask& task) {
  return trees.node(task.a).count + (task.a == task.b ? 0 : trees.node(task.b).count);
}

/// What a whole search consists of: a task for each chain and for each pair of chains. There may be many
/// pairs, so they are told one by one.
class ChainTasks {
 public:
  /// @param all  whether pairs of chains count whose roots are farther apart than the gap
  ChainTasks(const CageHierarchy& hierarchy, const ContactQuery& query, bool all);

  std::size_t chains() const { return roots_.size(); }

  /// Calls run(task) for the pairs of beads within a chain and for those of it and chains after it.
  template <class Run>
  void of_chain(std::size_t chain, const Run& run) const {
    const std::int32_t root = roots_[chain];
    if (query_.within_chains) run(ContactTask{root, root, static_cast<std::int32_t>(chain)});
    if (!query_.between_chains) return;
    const auto beside = [&](std::size_t other) { run(ContactTask{root, roots_[other], -1, is_open_}); };
    if (by_cells_) {
      for (const std::int32_t other : near_.row(chain)) beside(static_cast<std::size_t>(other));
    } else {
      for (std::size_t other = chain + 1; other < chains(); ++other) beside(other);
    }
  }

 private:
  void find_near(const CageHierarchy& hierarchy);

  Span<const std::int32_t> roots_;
  ContactQuery query_;
  bool is_open_;
  bool by_cells_ = false;
  NeighborList near_;  ///< of chains, if by cells
};

/// Cuts tasks into ranges that have about the same number of beads: where each begins, and the end.
std::vector<std::size_t> equal_ranges(const ChainTrees& trees, const std::vector<ContactTask>& tasks,
                                      std::size_t ranges);

}  // namespace dch::necklace::detail

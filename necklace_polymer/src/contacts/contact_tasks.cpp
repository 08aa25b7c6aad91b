// SPDX-License-Identifier: MIT
#include "contacts/contact_tasks.hpp"

#include <algorithm>

#include <dch/engines/pair_search.hpp>

namespace dch::necklace::detail {

namespace {

/// From how many chains on a cell list of roots is worth its cost.
constexpr std::size_t kManyChains = 32;

}  // namespace

ChainTasks::ChainTasks(const CageHierarchy& hierarchy, const ContactQuery& query, bool all)
    : roots_(hierarchy.trees().roots()), query_(query), is_open_(!hierarchy.box().any_periodic()) {
  if (query.between_chains && !all && chains() >= kManyChains) find_near(hierarchy);
}

/// Lists the chains whose roots may be within the gap, if the largest of these allows it.
void ChainTasks::find_near(const CageHierarchy& hierarchy) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  ListParams params;
  params.skin = std::max(query_.gap, 0.0) + hierarchy.rounding();
  double largest = 0;
  for (const std::int32_t root : roots_) {
    const Ball& cage = hierarchy.cages()[static_cast<std::size_t>(root)];
    centers.push_back(cage.center);
    radii.push_back(cage.radius * (1 + 1e-11));
    largest = std::max(largest, radii.back());
  }
  if (largest == 0 || 2 * largest + params.skin > hierarchy.box().max_cutoff()) return;
  params.radii = radii;
  const auto search = make_cell_search(params.list_radius());
  search->update(centers, hierarchy.box());
  near_ = search->list(params);
  by_cells_ = true;
}

std::vector<std::size_t> equal_ranges(const ChainTrees& trees, const std::vector<ContactTask>& tasks,
                                      std::size_t ranges) {
  std::int64_t beads = 0;
  for (const ContactTask& task : tasks) beads += beads_of(trees, task);
  const std::int64_t share = beads / static_cast<std::int64_t>(ranges) + 1;
  std::vector<std::size_t> begins{0};
  std::int64_t in_range = 0;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    in_range += beads_of(trees, tasks[k]);
    if (in_range < share) continue;
    begins.push_back(k + 1);
    in_range = 0;
  }
  if (begins.back() != tasks.size()) begins.push_back(tasks.size());
  return begins;
}

}  // namespace dch::necklace::detail

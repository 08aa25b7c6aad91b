// SPDX-License-Identifier: MIT
//
// Lists under motion: those of the hierarchy, of its classes of sizes and of the cell list equal all pairs at
// every step, on every instruction set and on threads, and a list that is kept between rebuilds lacks no pair
// within the cutoff.
#include <memory>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/engines/verlet_list.hpp>
#include <dch/lists/all_pairs.hpp>

#include "cluster_pair_check.hpp"
#include "fuzz_scene.hpp"
#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"

namespace dch::fuzz {
namespace {

constexpr std::size_t kMaxPoints = 80;

StructureParams choose_hierarchy(FuzzInput& input, const Scene& scene) {
  StructureParams params;
  params.radius = scene.reach * (1 + 1e-12);
  params.size_classes = input.coin();
  if (input.coin()) params.base_radius = scene.reach * input.uniform(0.2, 2);
  static const std::unique_ptr<Executor> threads = make_thread_pool(3);
  if (input.coin()) params.executor = threads.get();
  return params;
}

/// A superset holds all pairs, and none that is farther apart than its margin allows.
void require_superset(const NeighborList& list, const Scene& scene, const NeighborList& expected,
                      const std::string& where) {
  ListParams wider = scene.request;
  wider.skin += list.margin * (1 + 1e-12);
  const NeighborList sorted = sorted_by_index(list, scene.points.size()),
                     allowed = all_pairs(scene.points, scene.box, wider);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto row = sorted.row(i), least = expected.row(i), most = allowed.row(i);
    if (!std::includes(row.begin(), row.end(), least.begin(), least.end()))
      fail(where + ": the superset lacks a pair of row " + std::to_string(i));
    if (!std::includes(most.begin(), most.end(), row.begin(), row.end()))
      fail(where + ": row " + std::to_string(i) + " of the superset reaches beyond its margin");
  }
}

/// The lists of one engine, on every instruction set: the same as all pairs, and supersets that hold them.
void compare(PairSearch& search, const Scene& scene, const NeighborList& expected, const std::string& name) {
  const RestoreInstructionSet restore;
  ListParams superset = scene.request;
  superset.superset = true;
  superset.order = RowOrder::unsorted;
  NeighborList first_superset;
  for (const InstructionSet set : supported_sets()) {
    set_instruction_set(set);
    const std::string where = name + ", " + dch::name(set);
    require_none(first_difference(search.list(scene.request), expected), where);
    if (scene.request.kind == ListKind::full) continue;
    const NeighborList list = search.list(superset);
    if (set == InstructionSet::portable) {
      first_superset = list;
      if (list.margin + scene.reach < scene.box.max_cutoff()) require_superset(list, scene, expected, where);
    }
    if (list.margin != first_superset.margin) fail(where + ": another margin than the portable set has");
    require_none(first_difference(list, first_superset),
                 where + ", superset beside that of the portable set");
  }
}

/// Whether a kept list holds every pair within the cutoffs, skin left out.
void require_complete(const NeighborList& kept, const Scene& scene) {
  ListParams bare = scene.request;
  bare.skin = 0;
  const NeighborList pairs = all_pairs(scene.points, scene.box, bare);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto row = kept.row(i);
    for (const std::int32_t j : pairs.row(i))
      if (!std::binary_search(row.begin(), row.end(), j))
        fail("the kept list lacks the pair " + std::to_string(i) + ", " + std::to_string(j));
  }
}

void run(FuzzInput& input) {
  Scene scene;
  choose_scene(input, kMaxPoints, scene);
  const StructureParams params = choose_hierarchy(input, scene);
  const auto by_hierarchy = make_dch_search(params);
  const auto by_cells = make_cell_search(params.radius);
  const auto by_grid = make_grid_search(params.radius, params.executor);
  const auto by_choice = make_auto_search(params);
  const bool can_be_cluster_pairs =
      scene.radii.empty() && scene.request.exclusions == nullptr && scene.request.first_ghost < 0;
  VerletList kept(make_dch_search(params), scene.request);
  for (int step = 0; step < 4; ++step) {
    if (step > 0) move_points(input, scene.reach, scene.points);
    kept.update(scene.points, scene.box);
    require_complete(kept.list(), scene);
    const NeighborList expected = all_pairs(scene.points, scene.box, scene.request);
    by_hierarchy->update(scene.points, scene.box);
    compare(*by_hierarchy, scene, expected, "hierarchy, step " + std::to_string(step));
    if (by_hierarchy->has_cluster_pairs() && can_be_cluster_pairs) {
      ClusterPairs pairs;
      by_hierarchy->cluster_pairs(scene.request, pairs);
      require_none(cluster_pair_fault(pairs, scene.points, scene.box, scene.request), "cluster pairs");
    }
    by_grid->update(scene.points, scene.box);
    compare(*by_grid, scene, expected, "grid, step " + std::to_string(step));
    for (PairSearch* search : {by_cells.get(), by_choice.get()}) {
      search->update(scene.points, scene.box);
      require_none(first_difference(search->list(scene.request), expected),
                   search->name() + ", step " + std::to_string(step));
    }
    if (input.empty()) break;
  }
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  dch::fuzz::FuzzInput input(data, size);
  dch::fuzz::run(input);
  return 0;
} catch (const dch::InvalidBox&) {
  return 0;  // the free vectors made no box
}

// SPDX-License-Identifier: MIT
//
// What forces are made from: pairs that memory did not suffice for are empty or can be taken once more, and
// forces are added whole or not at all.
#include <dch/clusters/cluster_pairs.hpp>
#include <dch/forces/generalized_born.hpp>
#include <dch/forces/lennard_jones.hpp>
#include <dch/lists/pair_list.hpp>

#include "cluster_pair_check.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

constexpr std::size_t kForcePoints = 200;

ClusterPairs cluster_pairs_of(const Scene& scene, const ListParams& request) {
  ListedHierarchy hierarchy(params_for());
  hierarchy.build(scene.points, scene.box);
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  return pairs;
}

void sweep_refresh(Executor* executor) {
  const Scene scene(kForcePoints);
  ListParams wide, request;
  wide.cutoffs = TypeCutoffs(0.8);
  wide.skin = 0.2;
  request.cutoffs = TypeCutoffs(0.8);
  Scene moved = scene.shaken(0.05);
  for (std::size_t k = 0; k < kForcePoints; k += 3) moved.points[k] = moved.points[k] + moved.box.vector(0);
  Box wider = Box::orthorhombic({4.01, 4.5, 5});
  for (const Box& now : {moved.box, wider}) {
    expect_sound(sweep([&] { return cluster_pairs_of(scene, wide); },
                       [&](ClusterPairs& pairs) { pairs.refresh(moved.points, now, executor); },
                       [&](ClusterPairs& pairs, Ending ending) {
                         if (ending == Ending::threw) pairs.refresh(moved.points, now, executor);
                         return after(ending, cluster_pair_fault(pairs, moved.points, now, request));
                       }),
                 4);
  }
}

TEST(ForceFaults, ClusterPairsTakePositionsOnceMore) { sweep_refresh(nullptr); }
TEST(ForceFaults, ClusterPairsOnThreadsTakePositionsOnceMore) {
  const auto pool = make_thread_pool(2);
  sweep_refresh(pool.get());
}

TEST(ForceFaults, APairListIsWholeOrEmpty) {
  const Scene scene(kForcePoints);
  Asked asked;
  asked.answer(scene);
  const std::vector<std::int32_t> types(kForcePoints, 0);
  const auto make = [&](PairList& pairs) {
    make_pair_list(
        asked.expected, kRadius, scene.points, scene.box, types,
        [](std::int32_t, std::int32_t) { return true; }, pairs);
  };
  const auto count = [&](const PairList& pairs) {
    std::int64_t found = 0;
    pairs.for_each(scene.points, scene.box,
                   [&](std::int32_t, std::int32_t, Vec3 d) { found += norm2(d) <= 1; });
    return found;
  };
  const auto fault_of = [&](PairList& pairs, Ending ending) -> std::string {
    if (ending == Ending::threw) {
      if (pairs.pairs() != 0 || count(pairs) != 0 || pairs.particles != 0) return "the list is not empty";
      make(pairs);
    }
    return count(pairs) == asked.expected.pairs() ? "" : after(ending, "pairs are missing");
  };
  const auto used = [&] {
    PairList pairs;
    const NeighborList one = all_pairs({scene.points.data(), 20}, scene.box, asked.request);
    make_pair_list(
        one, kRadius, {scene.points.data(), 20}, scene.box, {},
        [](std::int32_t, std::int32_t) { return true; }, pairs);
    return pairs;
  };
  expect_sound(sweep([] { return PairList(); }, make, fault_of), 10);
  expect_sound(sweep(used, make, fault_of), 10);
}

/// Particles on a lattice, so that forces are finite.
struct Forces {
  Scene scene{0};
  std::vector<double> charges;
  ListParams request;
  ClusterPairs pairs;

  Forces() {
    scenes::Random random(4);
    scene.box = Box::orthorhombic({8, 8, 8});
    for (int k = 0; k < 512; ++k) {
      scene.points.push_back(Vec3{k % 8 + 0.0, k / 8 % 8 + 0.0, k / 64 + 0.0} + random.in_ball(0.1));
      charges.push_back(k % 2 == 0 ? 1 : -1);
    }
    request.cutoffs = TypeCutoffs(1.5);
    HierarchyParams params = params_for();
    params.radius = 1.5;
    ListedHierarchy hierarchy(params);
    hierarchy.build(scene.points, scene.box);
    hierarchy.cluster_pairs(request, pairs);
  }
  static LennardJones potential(Executor* executor) {
    LennardJones made({1, 0.9, 1.5});
    made.set_coulomb({1, 0, {1.5}, 0, 0});
    made.set_executor(executor);
    return made;
  }
  std::vector<Vec3> add(LennardJones& made, ForcePrecision precision) const {
    std::vector<Vec3> forces(scene.points.size());
    made.add_forces(pairs, precision, forces, charges);
    return forces;
  }
};

void sweep_forces(Executor* executor) {
  const Forces given;
  for (const ForcePrecision precision : {ForcePrecision::double_precision, ForcePrecision::mixed}) {
    LennardJones reference = Forces::potential(nullptr);
    const std::vector<Vec3> expected = given.add(reference, precision);
    struct Watched {
      LennardJones potential;
      std::vector<Vec3> forces;
    };
    expect_sound(
        sweep(
            [&] {
              return Watched{Forces::potential(executor), std::vector<Vec3>(given.scene.points.size())};
            },
            [&](Watched& subject) {
              subject.potential.add_forces(given.pairs, precision, subject.forces, given.charges);
            },
            [&](Watched& subject, Ending ending) -> std::string {
              const std::vector<Vec3> none(given.scene.points.size());
              if (subject.forces != (ending == Ending::threw ? none : expected))
                return after(ending, "the forces are neither as before nor right");
              return given.add(subject.potential, precision) == expected
                         ? ""
                         : after(ending, "the next forces are wrong");
            }),
        8);
  }
}

TEST(ForceFaults, ForcesAreAddedWholeOrNot) { sweep_forces(nullptr); }
TEST(ForceFaults, ForcesOnThreadsAreAddedWholeOrNot) {
  const auto pool = make_thread_pool(2);
  sweep_forces(pool.get());
}

TEST(ForceFaults, APotentialIsMadeOrNot) {
  expect_sound(sweep([] { return 0; }, [](int) { Forces::potential(nullptr); },
                     [](int, Ending) { return std::string(); }),
               20);
}

/// Integrals, energies and the chain of generalized Born sums, each on its own.
struct Born {
  BornSums sums;
  std::vector<double> integrals = std::vector<double>(512), slopes = std::vector<double>(512);
  std::vector<Vec3> forces = std::vector<Vec3>(512);

  explicit Born(Executor* executor) : sums(1.5, std::vector<BornParticle>(512, {0.3, 0.2}), true) {
    sums.set_executor(executor);
  }
  void add(const Forces& given, int pass) {
    const std::vector<double> born(512, 0.4);
    if (pass == 0) sums.add_integrals(given.pairs, integrals);
    if (pass == 1) sums.add_energies(given.pairs, {}, given.charges, born, forces, slopes, true);
    if (pass == 2) sums.add_chain(given.pairs, born, forces);
  }
  bool equals(const Born& other) const {
    return integrals == other.integrals && slopes == other.slopes && forces == other.forces;
  }
};

void sweep_born_sums(Executor* executor) {
  const Forces given;
  for (int pass = 0; pass < 3; ++pass) {
    const Born untouched(nullptr);
    Born expected(nullptr);
    expected.add(given, pass);
    expect_sound(sweep([&] { return Born(executor); }, [&](Born& subject) { subject.add(given, pass); },
                       [&](Born& subject, Ending ending) -> std::string {
                         if (!subject.equals(ending == Ending::threw ? untouched : expected))
                           return after(ending, "the sums are neither as before nor right");
                         if (ending != Ending::threw) return "";
                         subject.add(given, pass);
                         return subject.equals(expected) ? "" : "the sums are wrong the next time";
                       }),
                 4);
  }
}

TEST(ForceFaults, BornSumsAreAddedWholeOrNot) { sweep_born_sums(nullptr); }
TEST(ForceFaults, BornSumsOnThreadsAreAddedWholeOrNot) {
  const auto pool = make_thread_pool(2);
  sweep_born_sums(pool.get());
}

}  // namespace
}  // namespace dch::faults

// SPDX-License-Identifier: MIT
//
// Entries that stand two by two lose no pair, in every kind of box, and forces stay what they are.
#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "instruction_sets.hpp"
#include "listed_hierarchy.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kJoinedCutoff = 1.0, kJoinedSkin = 0.3;
constexpr int kTypes = 5;
constexpr int kRefreshesToJoin = 30;

/// Particles on a lattice that is shaken, 2.4 to a unit of volume; some leave the cell.
class JoinedEntries : public ::testing::TestWithParam<scenes::NamedBox> {
 protected:
  JoinedEntries() {
    constexpr int kSide = 13;
    scenes::Random random(21);
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y)
        for (int z = 0; z < kSide; ++z) {
          const Vec3 fraction = (1.0 / kSide) * Vec3{x + 0.0, y + 0.0, z + 0.0};
          const Vec3 at =
              box.kind() == Box::Kind::none ? 10.0 * fraction : scenes::from_fractional(box, fraction);
          points.push_back(at + random.in_ball(0.1));
          charges.push_back(random.uniform(-1, 1));
          types.push_back(static_cast<std::int32_t>(random.below(kTypes)));
        }
    random.shuffle(points);
    request.cutoffs = TypeCutoffs(kJoinedCutoff);
    request.skin = kJoinedSkin;
  }

  /// Pairs of a list before which another one has lived for so many steps.
  ClusterPairs searched(int refreshes, Executor* executor = nullptr) {
    StructureParams params;
    params.radius = request.list_radius();
    params.executor = executor;
    ListedHierarchy hierarchy(params);
    hierarchy.build(points, box);
    ClusterPairs pairs;
    hierarchy.cluster_pairs(request, pairs);
    for (int k = 0; k < refreshes; ++k) pairs.refresh(points, box);
    hierarchy.cluster_pairs(request, pairs);
    return pairs;
  }
  ClusterPairs joined(Executor* executor = nullptr) {
    ClusterPairs pairs = searched(kRefreshesToJoin, executor);
    pairs.join_entries(executor);
    return pairs;
  }

  Box box = GetParam().box;
  std::vector<Vec3> points;
  std::vector<double> charges;
  std::vector<std::int32_t> types;
  ListParams request;
};

std::vector<std::tuple<std::int32_t, int, int>> sorted_row(const ClusterPairs& pairs, std::size_t r) {
  std::vector<std::tuple<std::int32_t, int, int>> row;
  for (std::int64_t e = pairs.rows[r].first; e < pairs.rows[r + 1].first; ++e) {
    const ClusterPairs::Entry& entry = pairs.entries[static_cast<std::size_t>(e)];
    row.emplace_back(entry.cluster, entry.shift, entry.mask);
  }
  std::sort(row.begin(), row.end());
  return row;
}

/// Bits of the pairs of an entry that are within a distance, from positions in double precision.
std::uint32_t near_bits(const ClusterPairs& pairs, const ClusterPairs::Row& row,
                        const ClusterPairs::Entry& entry, double distance) {
  const auto& i = pairs.at[static_cast<std::size_t>(row.cluster)];
  const auto& j = pairs.at[static_cast<std::size_t>(entry.cluster)];
  const auto& by = pairs.shift_vector[static_cast<std::size_t>(row.first_shift) + entry.shift].whole;
  std::uint32_t bits = 0;
  for (int bit = 0; bit < 16; ++bit) {
    const int a = bit / 4, b = bit % 4;
    const Vec3 apart{j.x[b] + by.x[b] - i.x[a], j.y[b] + by.y[b] - i.y[a], j.z[b] + by.z[b] - i.z[a]};
    bits |= static_cast<std::uint32_t>(norm2(apart) <= distance * distance) << bit;
  }
  return bits;
}

TEST_P(JoinedEntries, HoldEachPairThatWasNearInTheSlotsOfItsEntry) {
  for (const InstructionSet set : supported_sets()) {
    const RestoreInstructionSet restore;
    set_instruction_set(set);
    const ClusterPairs before = searched(kRefreshesToJoin), pairs = joined();
    ASSERT_EQ(pairs.alone.size() + 1, pairs.rows.size());
    std::size_t two_by_two = 0;
    for (std::size_t r = 0; r + 1 < pairs.rows.size(); ++r) {
      const ClusterPairs::Row& row = pairs.rows[r];
      ASSERT_EQ(sorted_row(pairs, r), sorted_row(before, r)) << "row " << r;
      for (std::int64_t e = row.first + pairs.alone[r]; e < pairs.rows[r + 1].first; e += 2, ++two_by_two) {
        const auto& first = pairs.entries[static_cast<std::size_t>(e)];
        const auto& second = pairs.entries[static_cast<std::size_t>(e) + 1];
        const std::uint32_t of_second = pairs.of_second[static_cast<std::size_t>(e) / 2];
        ASSERT_EQ(first.mask & second.mask, 0xFFFF);
        const auto image = [&](const ClusterPairs::Entry& entry) {
          return pairs.shift[static_cast<std::size_t>(row.first_shift) + entry.shift].image;
        };
        ASSERT_EQ(image(first), image(second));
        ASSERT_EQ(near_bits(pairs, row, first, request.list_radius()) & of_second, 0u);
        ASSERT_EQ(near_bits(pairs, row, second, request.list_radius()) & ~of_second, 0u);
      }
    }
    EXPECT_GT(4 * two_by_two, pairs.entries.size()) << "half of all entries, at least";
  }
}

TEST_P(JoinedEntries, AreTheSameOnAnyNumberOfThreads) {
  const ClusterPairs alone = joined();
  for (const int threads : {2, 5}) {
    const auto pool = make_thread_pool(threads);
    const ClusterPairs together = joined(pool.get());
    EXPECT_EQ(together.alone, alone.alone);
    for (std::size_t r = 0; r < alone.alone.size(); ++r)
      for (std::int64_t e = alone.rows[r].first; e < alone.rows[r + 1].first; ++e) {
        const auto at = static_cast<std::size_t>(e);
        ASSERT_EQ(together.entries[at].cluster, alone.entries[at].cluster);
        const bool is_joined = e >= alone.rows[r].first + alone.alone[r];
        if (!is_joined) continue;
        ASSERT_EQ(together.of_second[at / 2], alone.of_second[at / 2]);
      }
  }
}

/// Potentials of each kind that kernels know, with what they need.
struct JoinedCase {
  std::string name;
  bool by_type = false, has_charges = false;
  std::function<LennardJones(const std::vector<std::int32_t>&)> make;
};

std::vector<double> cutoffs_of(int count) {
  return std::vector<double>(static_cast<std::size_t>(count) * static_cast<std::size_t>(count),
                             kJoinedCutoff);
}

LennardJones of_types() {
  std::vector<LennardJonesPair> matrix;
  for (int a = 0; a < kTypes; ++a)
    for (int b = 0; b < kTypes; ++b)
      matrix.push_back({0.5 + 0.1 * (a + b), 0.5 + 0.02 * (a + b), kJoinedCutoff - 0.03 * std::abs(a - b)});
  return {kTypes, matrix};
}

LennardJones of_particles(const std::vector<std::int32_t>& types) {
  std::vector<LennardJonesParticle> particles;
  for (const std::int32_t type : types) particles.push_back({0.4 + 0.2 * type, 0.5 + 0.03 * type});
  return {kJoinedCutoff, particles};
}

std::vector<JoinedCase> joined_cases() {
  using Types = const std::vector<std::int32_t>&;
  const LennardJonesPair pair{1, 0.6, kJoinedCutoff};
  std::vector<JoinedCase> cases;
  cases.push_back({"one type", false, false, [=](Types) { return LennardJones(pair); }});
  cases.push_back({"types", true, false, [](Types) { return of_types(); }});
  cases.push_back({"particles", false, false, [](Types types) { return of_particles(types); }});
  const auto add = [&](const std::string& name, bool by_type, const CoulombTerm& term,
                       double switch_from = -1) {
    cases.push_back({name, by_type, true, [=](Types types) {
                       LennardJones potential = by_type ? of_types() : of_particles(types);
                       CoulombTerm charges = term;
                       charges.cutoffs = cutoffs_of(potential.types());
                       potential.set_coulomb(charges);
                       if (switch_from >= 0) potential.set_switch(switch_from);
                       return potential;
                     }});
  };
  add("types with charges", true, {2, 0, {}, 0, 0, false});
  add("types and Ewald", true, {2, 2.5, {}, 0, 0, false});
  add("particles in a reaction field", false, {2, 0, {}, 0.4, 1.4, false});
  add("particles and Ewald by a series", false, {2, 2.5, {}, 0, 0, true});
  add("particles, Ewald and a switch", false, {2, 2.5, {}, 0, 0, true}, 0.8);
  add("particles in a field with a switch", false, {2, 0, {}, 0.4, 1.4, false}, 0.8);
  cases.push_back({"dispersion", false, true, [](Types types) {
                     LennardJones potential = of_particles(types);
                     potential.set_coulomb({2, 2.5, cutoffs_of(1), 0, 0, true});
                     potential.set_dispersion({2.0, std::vector<double>(types.size(), 0.3)});
                     return potential;
                   }});
  return cases;
}

double rms(const std::vector<Vec3>& a, const std::vector<Vec3>* b = nullptr) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += norm2(b ? a[i] - (*b)[i] : a[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// At the search, and when all particles have moved by half the skin.
TEST_P(JoinedEntries, GiveTheForcesOfDoublePrecision) {
  for (const JoinedCase& each : joined_cases()) {
    SCOPED_TRACE(each.name);
    if (each.by_type) {
      request.cutoffs = TypeCutoffs(kTypes, cutoffs_of(kTypes));
      request.types = types;
    } else {
      request.cutoffs = TypeCutoffs(kJoinedCutoff);
      request.types = {};
    }
    ClusterPairs pairs = joined();
    LennardJones potential = each.make(types);
    const Span<const double> given = each.has_charges ? Span<const double>(charges) : Span<const double>();
    scenes::Random random(5);
    std::vector<Vec3> moved = points;
    for (int step = 0; step < 2; ++step) {
      pairs.refresh(moved, box);
      std::vector<Vec3> expected(points.size()), found(points.size()), summed(points.size());
      const LennardJonesSums in_double =
          potential.add_forces_and_sum(pairs, ForcePrecision::double_precision, expected, given);
      potential.add_forces(pairs, ForcePrecision::mixed, found, given);
      const LennardJonesSums in_mixed =
          potential.add_forces_and_sum(pairs, ForcePrecision::mixed, summed, given);
      EXPECT_LT(rms(found, &expected), 3e-6 * rms(expected));
      EXPECT_LT(rms(summed, &expected), 3e-6 * rms(expected));
      EXPECT_NEAR(in_mixed.energy, in_double.energy, 1e-5 * std::abs(in_double.energy) + 1e-3);
      EXPECT_NEAR(in_mixed.virial[0], in_double.virial[0], 1e-5 * std::abs(in_double.virial[0]) + 1e-3);
      for (Vec3& p : moved) p = p + random.in_ball(0.499 * kJoinedSkin);
    }
  }
}

TEST_P(JoinedEntries, AreMadeOnlyAfterASearchAndWhereListsLiveLong) {
  ClusterPairs pairs = searched(kRefreshesToJoin - 1);
  pairs.join_entries();
  EXPECT_TRUE(pairs.alone.empty());
  pairs = joined();
  EXPECT_FALSE(pairs.alone.empty());
  pairs.refresh(points, box);
  try {
    pairs.join_entries();
    FAIL();
  } catch (const InvalidParameter& error) {
    EXPECT_NE(std::string(error.what()).find("refresh() had been called 1 times"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, JoinedEntries, ::testing::ValuesIn(scenes::all_boxes(10.0)),
                         [](const auto& p) { return p.param.name; });

/// Integers of coordinates wrap at 2^32 units: two particles that far apart would stand in one place.
TEST(UnitsOfClusters, AreCoarserWhenAParticleGoesFar) {
  const std::vector<Vec3> points{{0, 0, 0}, {0.9, 0, 0}, {0, 0.9, 0}, {0, 0, 0.9}, {0.9, 0.9, 0}};
  ListParams request;
  request.cutoffs = TypeCutoffs(1.0);
  request.skin = 0.2;
  ListedHierarchy hierarchy = hierarchy_of(points, Box::none(), request.list_radius());
  ClusterPairs pairs;
  hierarchy.cluster_pairs(request, pairs);
  LennardJones potential({1, 0.8, 1.0});
  const double period = std::ldexp(pairs.unit, 32);
  for (const double far : {period, -period, 3 * period}) {
    std::vector<Vec3> moved = points;
    moved[1] = points[0] + Vec3{far, 0.01, 0};
    pairs.refresh(moved, Box::none());
    EXPECT_GT(std::ldexp(pairs.unit, 32), std::abs(far));
    std::vector<Vec3> mixed(points.size()), full(points.size());
    potential.add_forces(pairs, ForcePrecision::mixed, mixed);
    potential.add_forces(pairs, ForcePrecision::double_precision, full);
    EXPECT_EQ(norm2(mixed[1]), 0.0);
    EXPECT_LT(rms(mixed, &full), 1e-4 * rms(full));
  }
}

}  // namespace
}  // namespace dch

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "effort.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::Vec3;
using dch::necklace::any_contact;
using dch::necklace::Chains;
using dch::necklace::ContactFinder;
using dch::necklace::ContactFinderParams;
using dch::necklace::ContactQuery;
using dch::necklace::ContactStats;
using dch::necklace::find_contacts;
using dch::necklace::LayeredHierarchy;
using dch::necklace::Necklace;
using dch::necklace::WrappedHierarchy;
using dch::scenes::Random;
using dch::test::same;

/// Chains of 2 to 2,000 beads in all, open and closed, in a box, with solvent between them.
struct Scene {
  Necklace necklace;
  std::vector<Vec3> positions;
  Box box;
  ContactQuery query;
};

/// A walk of bonds of length 1; a closed one ends one bond from where it started.
std::vector<Vec3> walk(std::size_t beads, bool closed, Vec3 start, double straightness, Random& random) {
  std::vector<Vec3> result{start};
  Vec3 ahead;
  while (result.size() < beads) {
    const Vec3 turned = straightness * ahead + random.in_ball(1);
    const double length = std::sqrt(norm2(turned));
    if (length < 0.01) continue;
    ahead = (1 / length) * turned;
    result.push_back(result.back() + ahead);
  }
  if (closed) {
    const Vec3 back = result.front() - result.back();
    for (std::size_t k = 0; k < beads; ++k) {
      result[k] = result[k] + (static_cast<double>(k) / static_cast<double>(beads)) * back;
    }
  }
  return result;
}

Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  // Wide enough for the largest radii and gap below.
  const auto boxes = dch::scenes::all_boxes(random.uniform(8, 22));
  scene.box = boxes[seed % boxes.size()].box;
  const auto total = static_cast<std::size_t>(2 * std::pow(1000, random.uniform()));
  const std::size_t particles = total + random.below(5);
  std::vector<std::int32_t> names(particles);
  for (std::size_t k = 0; k < particles; ++k) names[k] = static_cast<std::int32_t>(k);
  if (random.uniform() < 0.5) random.shuffle(names);
  Chains chains(particles);
  scene.positions.assign(particles, Vec3{});
  const double straightness = random.uniform(0, 3);
  for (std::size_t begin = 0; begin < total;) {
    const std::size_t beads = random.uniform() < 0.4 ? total - begin : 1 + random.below(total - begin);
    const bool closed = beads >= 3 && random.uniform() < 0.4;
    const Vec3 start =
        dch::scenes::from_fractional(scene.box, {random.uniform(), random.uniform(), random.uniform()});
    const auto chain = walk(beads, closed, start, straightness, random);
    chains.add({names.data() + begin, beads}, closed);
    for (std::size_t k = 0; k < beads; ++k) {
      scene.positions[static_cast<std::size_t>(names[begin + k])] = scene.box.wrap(chain[k]);
    }
    begin += beads;
  }
  std::vector<double> radii(particles);
  const double ratio = std::pow(20, random.uniform()), largest = random.uniform(0.3, 0.8);
  for (double& radius : radii) radius = largest * std::pow(ratio, -random.uniform());
  scene.necklace = Necklace(chains, radii);
  scene.query.skip_bonds = static_cast<int>(random.below(6));
  scene.query.gap = random.uniform() < 0.3 ? 0 : random.uniform(0, 0.8);
  scene.query.within_chains = random.uniform() < 0.9;
  scene.query.between_chains = random.uniform() < 0.9;
  return scene;
}

/// Of scenes of up to this many particles every answer is checked, of larger ones of every tenth.
constexpr std::size_t kSmall = 300;

/// Returns how many contacts there are.
std::size_t check(const Scene& scene, std::uint64_t seed) {
  const std::string where = "seed " + std::to_string(seed) + ", " + scene.box.description();
  // Seeds go round the nine boxes.
  const std::uint64_t round = seed / 9;
  const int leaf_beads = round % 3 == 0 ? 1 : round % 3 == 1 ? 8 : 5;
  WrappedHierarchy wrapped(scene.necklace, {leaf_beads, dch::necklace::Verification::cascade});
  wrapped.build(scene.positions, scene.box);
  const auto expected = dch::test::contact_oracle(scene.necklace, scene.positions, scene.box, scene.query);
  const auto found = dch::test::pairs_of(find_contacts(wrapped, scene.query));
  EXPECT_EQ(found, expected) << where;
  EXPECT_EQ(any_contact(wrapped, scene.query), !expected.empty()) << where;
  if (scene.positions.size() > kSmall && seed % 10 != 0) return expected.size();
  EXPECT_EQ(dch::test::listed_contacts(scene.necklace, scene.positions, scene.box, scene.query), expected)
      << where;
  LayeredHierarchy layered(scene.necklace);
  layered.update(scene.positions, scene.box);
  EXPECT_EQ(dch::test::pairs_of(find_contacts(layered, scene.query)), expected) << where;
  const auto separation = dch::necklace::separate(wrapped, scene.query);
  EXPECT_EQ(dch::test::pairs_of(separation.contacts), expected) << where;
  EXPECT_EQ(dch::necklace::check_certificate(wrapped, scene.query, separation), "") << where;
  return expected.size();
}

TEST(NecklaceContacts, EqualBruteForceInAThousandRandomScenes) {
  const auto scenes = static_cast<std::uint64_t>(dch::effort(1000));
  std::uint64_t with_contacts = 0;
  for (std::uint64_t seed = 1; seed <= scenes && !HasFailure(); ++seed) {
    with_contacts += check(random_scene(seed), seed) > 0 ? 1 : 0;
  }
  // Both answers to the yes/no query are common.
  EXPECT_GT(5 * with_contacts, scenes);
  EXPECT_LT(5 * with_contacts, 4 * scenes);
}

TEST(NecklaceContacts, EqualBruteForceUnderMotion) {
  for (std::uint64_t seed = 2001; seed <= 2040; ++seed) {
    Scene scene = random_scene(seed);
    if (scene.positions.size() > 500) continue;
    const auto verification =
        seed % 2 == 0 ? dch::necklace::Verification::watched : dch::necklace::Verification::cascade;
    WrappedHierarchy wrapped(scene.necklace, {8, verification});
    Random random(seed);
    for (int step = 0; step < 5; ++step) {
      wrapped.update(scene.positions, scene.box);
      ASSERT_EQ(dch::test::pairs_of(find_contacts(wrapped, scene.query)),
                dch::test::contact_oracle(scene.necklace, scene.positions, scene.box, scene.query))
          << "seed " << seed << ", step " << step;
      for (Vec3& p : scene.positions) p = p + random.in_ball(0.05);
    }
  }
}

/// Contacts, to the last bit, and the work are those of one thread; by either structure.
void expect_same_on_threads(const Scene& scene, dch::Executor& threads, const std::string& where) {
  WrappedHierarchy wrapped(scene.necklace);
  wrapped.build(scene.positions, scene.box);
  ContactStats stats, threads_stats;
  const auto expected = find_contacts(wrapped, scene.query, &stats);
  const auto found = find_contacts(wrapped, scene.query, &threads_stats, &threads);
  EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same)) << where;
  EXPECT_EQ(threads_stats.cage_pairs, stats.cage_pairs) << where;
  EXPECT_EQ(threads_stats.bead_pairs, stats.bead_pairs) << where;
  EXPECT_EQ(any_contact(wrapped, scene.query, nullptr, &threads), !expected.empty()) << where;
  ContactFinderParams params;
  params.to_dch = params.to_wrapped = 0;  // the DCH after the first search
  params.executor = &threads;
  ContactFinder finder(scene.necklace, params);
  for (int search = 0; search < 2; ++search) {
    finder.update(scene.positions, scene.box);
    const auto chosen = finder.find_contacts(scene.query);
    EXPECT_TRUE(std::equal(chosen.begin(), chosen.end(), expected.begin(), expected.end(), same)) << where;
    EXPECT_EQ(finder.any_contact(scene.query), !expected.empty()) << where;
  }
}

TEST(NecklaceContacts, AreTheSameOnSeveralThreads) {
  const int counts[] = {2, 3, 16};
  std::uint64_t seed = 3001;
  for (const int count : counts) {
    const auto threads = dch::make_thread_pool(count);
    const std::uint64_t end = seed + static_cast<std::uint64_t>(dch::effort(60));
    for (; seed < end && !HasFailure(); ++seed) {
      expect_same_on_threads(random_scene(seed), *threads,
                             "seed " + std::to_string(seed) + " on " + std::to_string(count) + " threads");
    }
  }
}

/// One long chain, which only parts of its tree can keep threads busy with.
TEST(NecklaceContacts, OfALongChainAreTheSameOnSeveralThreads) {
  const auto threads = dch::make_thread_pool(3);
  for (const bool closed : {false, true}) {
    Random random(8);
    Scene scene;
    scene.positions = walk(6000, closed, {}, 0.5, random);
    Chains chains(scene.positions.size());
    std::vector<std::int32_t> names(scene.positions.size());
    for (std::size_t k = 0; k < names.size(); ++k) names[k] = static_cast<std::int32_t>(k);
    chains.add(names, closed);
    scene.necklace = Necklace(chains, 0.5);
    scene.query.gap = 0.1;
    expect_same_on_threads(scene, *threads, closed ? "ring" : "open chain");
  }
}

/// Enough chains for pairs of roots to come from a cell list.
TEST(NecklaceContacts, ManyShortChains) {
  for (const auto& named : dch::scenes::all_boxes(14)) {
    Random random(5);
    Chains chains(400);
    Scene scene;
    scene.box = named.box;
    for (std::int32_t chain = 0; chain < 100; ++chain) {
      const Vec3 start =
          dch::scenes::from_fractional(scene.box, {random.uniform(), random.uniform(), random.uniform()});
      for (const Vec3& p : walk(4, false, start, 1, random)) scene.positions.push_back(scene.box.wrap(p));
      chains.add(std::vector<std::int32_t>{4 * chain, 4 * chain + 1, 4 * chain + 2, 4 * chain + 3});
    }
    scene.necklace = Necklace(chains, 0.5);
    scene.query.gap = 0.2;
    EXPECT_GT(check(scene, 10), 0U) << named;
  }
}

}  // namespace

// SPDX-License-Identifier: MIT
//
// More than 300 lines: one test a promise of contact_finder.hpp, all in both turns.
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>

#include "contact_oracle.hpp"
#include "effort.hpp"
#include "error_message.hpp"
#include "random.hpp"
#include "scenes.hpp"

namespace {

using dch::Box;
using dch::CutoffTooLarge;
using dch::InvalidParameter;
using dch::InvalidPosition;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::ContactFinder;
using dch::necklace::ContactFinderParams;
using dch::necklace::ContactQuery;
using dch::necklace::Necklace;
using dch::necklace::Shape;
using dch::necklace::Structure;
using dch::necklace::WrappedHierarchy;
using dch::scenes::Random;
using dch::test::message_of;
using dch::test::same;
using testing::HasSubstr;

/// Takes the DCH after its first search, whatever the scene.
ContactFinderParams always_dch() {
  ContactFinderParams params;
  params.to_dch = params.to_wrapped = 0;
  params.wrapped.leaf_beads = 1;  // of few beads too some are compared
  params.measure_every = 1000000;
  return params;
}

/// Beads that touch their neighbors count, so that all pairs are compared.
const ContactQuery kAllPairs{0, 0, true, true};

/// Makes the first search, which measures.
void measure(ContactFinder& finder, const std::vector<Vec3>& positions, const Box& box) {
  finder.update(positions, box);
  finder.find_contacts({});
}

/// The DCH gives the contacts of the wrapped hierarchy, bit for bit.
void expect_same(const Necklace& necklace, const std::vector<Vec3>& positions, const Box& box,
                 const ContactQuery& query, const std::string& where) {
  WrappedHierarchy wrapped(necklace);
  wrapped.build(positions, box);
  const auto expected = find_contacts(wrapped, query);
  ContactFinder finder(necklace, always_dch());
  measure(finder, positions, box);
  const auto found = finder.find_contacts(query);
  ASSERT_EQ(found.size(), expected.size()) << where;
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_TRUE(same(found[k], expected[k])) << where << ", " << k;
  EXPECT_EQ(finder.any_contact(query), !expected.empty()) << where;
  EXPECT_EQ(dch::test::pairs_of(found), dch::test::contact_oracle(necklace, positions, box, query)) << where;
}

TEST(ContactFinder, BothStructuresGiveTheSameContacts) {
  int seed = 0;
  for (const auto& named : dch::scenes::all_boxes(9)) {
    for (int round = 0; round < dch::effort(8); ++round) {
      Random random(static_cast<std::uint64_t>(++seed));
      Chains chains(64);
      std::vector<Vec3> positions;
      std::vector<std::int32_t> names;
      Vec3 at = dch::scenes::from_fractional(named.box, {0.3, 0.9, 0.5});
      for (std::int32_t k = 0; k < 64; ++k, at = at + random.in_ball(0.9)) {
        positions.push_back(named.box.wrap(at));
        names.push_back(63 - k);
      }
      chains.add({names.data(), 40});
      chains.add({names.data() + 40, 20});
      std::vector<double> radii(64);
      for (double& radius : radii) radius = round % 2 == 0 ? 0.4 : 0.8 * std::pow(20, -random.uniform());
      ContactQuery query;
      query.gap = random.uniform(-0.2, 0.8);
      query.skip_bonds = static_cast<int>(random.below(4));
      query.within_chains = random.uniform() < 0.8;
      query.between_chains = random.uniform() < 0.8;
      expect_same(Necklace(chains, radii), positions, named.box, query,
                  named.name + ", seed " + std::to_string(seed));
      if (HasFailure()) return;
    }
  }
}

TEST(ContactFinder, PointsFewBeadsAndNone) {
  expect_same(Necklace::chain(std::vector<double>(40, 0)), std::vector<Vec3>(40, {1, 2, 3}), Box::none(), {},
              "points at one place");
  expect_same(Necklace::chain({0.5}), {{1, 2, 3}}, Box::none(), {}, "one");
  expect_same(Necklace::chain({}), {}, Box::none(), {}, "none");
  expect_same(Necklace::chain({0.5, 0.5}), {{1, 2, 3}, {1, 2, 3}}, Box::none(), {0, 0, true, true}, "two");
}

/// What the wrapped hierarchy answers and the DCH does not take.
TEST(ContactFinder, AnswersWhateverTheWrappedHierarchyAnswers) {
  Random random(7);
  std::vector<Vec3> positions(40);
  for (Vec3& p : positions) p = random.in_ball(2);
  positions[7] = positions[30];
  const auto scaled = [&](double by) {
    std::vector<Vec3> result = positions;
    for (Vec3& p : result) p = by * p;
    return result;
  };
  const std::vector<double> points(40, 0.0), tiny(40, 1e-300);
  std::vector<double> mixed(40, 1e-300);
  for (std::size_t k = 0; k < 40; k += 3) mixed[k] = 0.5;
  for (const Box& box : {Box::none(), Box::orthorhombic({8, 8, 8})})
    for (const double gap : {0.0, 1e-300, 1e-40, 0.4}) {
      const ContactQuery query{gap, 0, true, true};
      const std::string where = box.description() + ", gap " + std::to_string(gap);
      expect_same(Necklace::chain(points), positions, box, query, "points, " + where);
      expect_same(Necklace::chain(tiny), positions, box, query, "tiny beads, " + where);
      expect_same(Necklace::chain(mixed), positions, box, query, "mixed beads, " + where);
    }
  expect_same(Necklace::chain(std::vector<double>(40, 0.3e40)), scaled(1e40), Box::none(), {}, "huge");
  expect_same(Necklace::chain(std::vector<double>(40, 0.3e-60)), scaled(1e-60), Box::none(), {}, "minute");
  expect_same(Necklace::chain({}), {}, Box::none(), {1, 0, true, true}, "none, with a gap");
  // A bead that rounding leaves anywhere in the box; bonds would be longer than half of it.
  Chains single(2);
  single.add(std::vector<std::int32_t>{0});
  single.add(std::vector<std::int32_t>{1});
  expect_same(Necklace(single, 0.5), {{1e17, 0, 0}, {1e17, 0, 0}}, Box::orthorhombic({10, 10, 10}), {},
              "far");
}

TEST(ContactFinder, PackedChainsGoToTheDchAndStretchedOnesComeBack) {
  ContactFinderParams params;
  params.to_dch = 3, params.to_wrapped = 2;
  params.wrapped.leaf_beads = 1;
  params.measure_every = 3;
  const Shape line = dch::necklace::grid_necklace(512, 1, 1), cube = dch::necklace::grid_necklace(8, 8, 8);
  ContactFinder finder(necklace_of(line, 0.49), params);
  EXPECT_THAT(finder.choice().reason, HasSubstr("no search yet"));
  EXPECT_LT(finder.choice().visited_per_bead, 0);
  finder.update(line.positions, Box::none());
  EXPECT_FALSE(finder.any_contact(kAllPairs));
  EXPECT_EQ(finder.choice().structure, Structure::wrapped);
  EXPECT_NEAR(finder.choice().visited_per_bead, 1, 0.01);
  EXPECT_THAT(finder.choice().reason, HasSubstr("below 2.00: the wrapped hierarchy"));
  finder.update(cube.positions, Box::none());
  EXPECT_FALSE(finder.any_contact(kAllPairs));
  EXPECT_EQ(finder.choice().structure, Structure::dch);
  EXPECT_THAT(finder.choice().reason, HasSubstr("above 3.00: the DCH"));
  finder.update(line.positions, Box::none());
  for (const Structure expected : {Structure::dch, Structure::dch, Structure::wrapped}) {
    EXPECT_FALSE(finder.any_contact(kAllPairs));
    EXPECT_EQ(finder.choice().structure, expected);
  }
}

TEST(ContactFinder, BetweenTheThresholdsNothingChanges) {
  const Shape cube = dch::necklace::grid_necklace(8, 8, 8), line = dch::necklace::grid_necklace(512, 1, 1);
  ContactFinderParams params;
  params.wrapped.leaf_beads = 1;
  params.to_dch = 30, params.to_wrapped = 0.5;
  params.measure_every = 1;
  ContactFinder finder(necklace_of(line, 0.49), params);
  finder.update(line.positions, Box::none());
  finder.find_contacts(kAllPairs);
  EXPECT_EQ(finder.choice().structure, Structure::wrapped);
  EXPECT_THAT(finder.choice().reason, HasSubstr("as before"));
  finder.update(cube.positions, Box::none());
  finder.find_contacts(kAllPairs);
  EXPECT_EQ(finder.choice().structure, Structure::dch);
  finder.update(line.positions, Box::none());
  finder.find_contacts(kAllPairs);
  EXPECT_EQ(finder.choice().structure, Structure::dch);
  EXPECT_THAT(finder.choice().reason, HasSubstr("as before"));
}

/// One finder under changing gaps, boxes and positions.
TEST(ContactFinder, FollowsWhateverChanges) {
  const Shape cube = dch::necklace::globule(400, 0.2, 3);
  const Necklace necklace = necklace_of(cube, 0.4);
  ContactFinder finder(necklace, always_dch());
  measure(finder, cube.positions, Box::none());
  std::vector<Vec3> positions = cube.positions;
  Random random(4);
  for (int step = 0; step < 12; ++step) {
    const Box box =
        step % 3 == 0 ? Box::none() : Box::orthorhombic((step % 3 == 1 ? 40.0 : 12.0) * Vec3{1, 1, 1});
    for (Vec3& p : positions) p = p + random.in_ball(0.05);
    finder.update(positions, box);
    for (const double gap : {0.0, 2.5, 0.3}) {
      const ContactQuery query{gap, 2, true, true};
      EXPECT_EQ(dch::test::pairs_of(finder.find_contacts(query)),
                dch::test::contact_oracle(necklace, positions, box, query))
          << "step " << step << ", gap " << gap;
    }
  }
  EXPECT_EQ(finder.choice().structure, Structure::dch);
}

/// What the finder says in the wrapped hierarchy's turn and in the DCH's.
template <class Ask>
void ask_in_both_turns(const Necklace& necklace, const std::vector<Vec3>& positions, const Box& box,
                       const Ask& ask) {
  for (const bool is_dch : {false, true}) {
    SCOPED_TRACE(is_dch ? "the DCH's turn" : "the wrapped hierarchy's turn");
    ContactFinder finder(necklace, always_dch());
    const std::vector<Vec3> stretched(positions.size(), Vec3{1, 1, 1});
    if (is_dch) measure(finder, stretched, box);
    ASSERT_EQ(finder.choice().structure, is_dch ? Structure::dch : Structure::wrapped);
    finder.update(positions, box);
    ask(finder);
    finder.update(stretched, box);
    EXPECT_NO_THROW(finder.find_contacts({})) << "in the next frame";
  }
}

// The wrapped hierarchy needs whole chains; contacts do not.
TEST(ContactFinder, OtherChainsTakeTheChoiceOver) {
  Random random(5);
  std::vector<Vec3> positions(60);
  for (Vec3& p : positions) p = random.in_ball(2);
  const Box box = Box::orthorhombic({9, 9, 9});
  const Necklace all = Necklace::chain(std::vector<double>(60, 0.4));
  const Necklace part = Necklace::chain(std::vector<double>(40, 0.3));
  ContactFinder finder(all, always_dch());
  measure(finder, positions, box);
  const double visited = finder.choice().visited_per_bead;
  finder.replace(part);
  EXPECT_EQ(finder.necklace().size(), 40u);
  EXPECT_THROW(finder.find_contacts({}), InvalidParameter);  // there are no positions yet
  positions.resize(40);
  finder.update(positions, box);
  const auto found = finder.find_contacts({});
  EXPECT_EQ(finder.answered_by(), Structure::dch);  // without measuring first
  EXPECT_EQ(finder.choice().visited_per_bead, visited);
  EXPECT_EQ(dch::test::pairs_of(found), dch::test::contact_oracle(part, positions, box, {}));
}

/// Of chains of beads of one size, of two, and of one again; each time others are missing.
TEST(ContactFinder, BeadsThatComeAndGoKeepTheirNames) {
  Random random(6);
  const Box box = Box::orthorhombic({9, 9, 9});
  std::vector<Vec3> all(90);
  for (Vec3& p : all) p = random.in_ball(1.8);  // bonds stay below half the box
  ContactFinder finder(Necklace(), always_dch());
  for (std::uint64_t round = 0; round < 30; ++round) {
    std::vector<std::uint64_t> names;
    std::vector<Vec3> positions;
    std::vector<double> radii;
    for (std::uint64_t name = 0; name < all.size(); ++name) {
      all[name] = all[name] + random.in_ball(0.05);
      if ((name + round) % 5 == 0) continue;
      names.push_back(name);
      positions.push_back(all[name]);
      radii.push_back(round / 5 % 2 == 1 && name % 3 == 0 ? 0.1 : 0.3);
    }
    if (round % 7 == 6) names.clear();
    const Necklace chain = Necklace::chain(radii);
    finder.replace(chain, names);
    finder.update(positions, box);
    const auto found = finder.find_contacts({});
    EXPECT_EQ(finder.answered_by(), round == 0 ? Structure::wrapped : Structure::dch);
    EXPECT_EQ(dch::test::pairs_of(found), dch::test::contact_oracle(chain, positions, box, {})) << round;
  }
  EXPECT_THROW(finder.replace(Necklace::chain({0.5, 0.5}), std::vector<std::uint64_t>{1}), InvalidParameter);
}

TEST(ContactFinder, BondsThatLeaveImagesUndeterminedDoNotHideContacts) {
  const Box box = Box::orthorhombic({9, 9, 9});
  const std::vector<double> radii(5, 0.6);
  const std::vector<Vec3> broken{{1, 1, 1}, {1, 1, 2.1}, {1, 1, 6.9}, {1.5, 1.5, 1}, {8, 8, 6.9}};
  const std::vector<Vec3> winding{{0, 1, 1}, {2, 1, 1}, {4, 1, 1}, {6, 1, 1}, {8, 1, 1}};
  std::vector<dch::IndexPair> path{{0, 1}, {1, 2}, {2, 3}, {3, 4}}, ring = path;
  ring.push_back({4, 0});
  for (const auto& [bonds, positions] : {std::pair{path, broken}, std::pair{ring, winding}}) {
    const Necklace necklace(Chains::from_bonds(5, bonds), radii);
    WrappedHierarchy wrapped(necklace);
    EXPECT_THROW(wrapped.build(positions, box), dch::necklace::Undetermined);
    const ContactQuery query{0.9, 0, true, true};
    const auto expected = dch::test::contact_oracle(necklace, positions, box, query);
    ASSERT_GE(expected.size(), 2u);
    ask_in_both_turns(necklace, positions, box, [&](ContactFinder& finder) {
      EXPECT_EQ(dch::test::pairs_of(finder.find_contacts(query)), expected);
      EXPECT_TRUE(finder.any_contact(query));
      EXPECT_FALSE(finder.any_contact({-1.1, 1, true, true}));
      EXPECT_THROW(finder.find_contacts({NAN, 1, true, true}), InvalidParameter);
    });
  }
}

// Hosts to which such bonds are chains of something else have them refused, by the same words in both turns.
TEST(ContactFinder, RefusesUndeterminedBondsInBothTurnsIfTold) {
  const Box box = Box::orthorhombic({9, 9, 9});
  struct Case {
    const char* text;
    bool closed;
    std::vector<Vec3> positions;
  };
  const Case cases[] = {
      {"bond 1-2 is 5.6", false, {{1, 1, 1}, {1, 1, 2.1}, {5, 5, 2.1}, {5, 5, 3}}},
      {"bond 3-0 is 5.6", true, {{1, 1, 1}, {1, 3, 1}, {3, 5, 1}, {5, 5, 1}}},
      {"the ring at bead 0 winds", true, {{0, 1, 1}, {2.2, 1, 1}, {4.4, 1, 1}, {6.6, 1, 1}}}};
  for (const Case& of : cases)
    for (const bool is_dch : {false, true}) {
      Chains chains(4);
      chains.add(std::vector<std::int32_t>{0, 1, 2, 3}, of.closed);
      ContactFinderParams params = always_dch();
      params.refuse_undetermined = true;
      ContactFinder finder(Necklace(chains, 0.6), params);
      if (is_dch) measure(finder, std::vector<Vec3>(4, Vec3{1, 1, 1}), box);
      ASSERT_EQ(finder.choice().structure, is_dch ? Structure::dch : Structure::wrapped);
      finder.update(of.positions, box);
      const auto expect_refused = [&](const auto& search) {
        EXPECT_THAT(message_of<dch::necklace::Undetermined>(search), HasSubstr(of.text));
      };
      expect_refused([&] { finder.find_contacts({}); });
      expect_refused([&] { finder.any_contact({}); });
      expect_refused([&] { finder.prepare({}); });
      finder.update(of.positions, Box::none());
      EXPECT_NO_THROW(finder.find_contacts({})) << "in open space no bond is too long";
    }
}

TEST(ContactFinder, TellsItsMemory) {
  const Shape cube = dch::necklace::globule(400, 0.2, 3);
  ContactFinder finder(necklace_of(cube, 0.4), always_dch());
  const std::size_t empty = finder.memory_bytes();
  measure(finder, cube.positions, Box::none());
  const std::size_t wrapped = finder.memory_bytes();
  EXPECT_GE(wrapped, empty + 400 * (sizeof(dch::Vec3) + sizeof(dch::necklace::Ball)));
  finder.find_contacts({});
  EXPECT_GE(finder.memory_bytes(), wrapped + 400 * sizeof(dch::Vec3));
}

TEST(ContactFinder, CountsBondsAroundRingsTheShorterWayInBothTurns) {
  Chains chains(6);
  chains.add(std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}, true);
  const Necklace ring(chains, 1.0);  // all touch all
  std::vector<Vec3> hexagon;
  for (int k = 0; k < 6; ++k) hexagon.push_back({std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0});
  ask_in_both_turns(ring, hexagon, Box::none(), [&](ContactFinder& finder) {
    const std::size_t contacts[] = {15, 9, 3, 0};  // 6, 6 and 3 pairs are 1, 2 and 3 bonds apart
    for (int skip = 0; skip < 4; ++skip)
      EXPECT_EQ(finder.find_contacts({0.1, skip, true, true}).size(), contacts[skip]) << skip;
  });
}

TEST(ContactFinder, WhatNeitherStructureTakesIsRefusedInBothTurns) {
  const Necklace points = Necklace::chain({0, 0, 0});  // the DCH takes no points that are to coincide
  const std::vector<Vec3> broken{{1, 1, 1}, {5, 5, 5}, {1, 1, 1}};
  ask_in_both_turns(points, broken, Box::orthorhombic({9, 9, 9}), [](ContactFinder& finder) {
    EXPECT_THROW(finder.find_contacts({0, 1, true, true}), dch::necklace::Undetermined);
    EXPECT_THROW(finder.any_contact({0, 1, true, true}), dch::necklace::Undetermined);
  });
}

TEST(ContactFinder, RefusesBadInput) {
  const Necklace necklace = Necklace::chain({0.5, 0.5, 0.5});
  ContactFinderParams params;
  params.to_wrapped = params.to_dch + 1;
  EXPECT_THAT(message_of<InvalidParameter>([&] { ContactFinder(necklace, params); }),
              HasSubstr("to_wrapped"));
  params = {};
  params.measure_every = 0;
  EXPECT_THAT(message_of<InvalidParameter>([&] { ContactFinder(necklace, params); }),
              HasSubstr("measure_every is 0"));
  ContactFinder finder(necklace, always_dch());
  EXPECT_THAT(message_of<InvalidParameter>([&] { finder.find_contacts({}); }), HasSubstr("no positions"));
  const std::vector<Vec3> three{{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}};
  measure(finder, three, Box::none());
  ASSERT_EQ(finder.choice().structure, Structure::dch);
  EXPECT_THROW(finder.find_contacts({NAN, 1, true, true}), InvalidParameter);
  EXPECT_THROW(finder.any_contact({0, -1, true, true}), InvalidParameter);
  finder.update(three, Box::orthorhombic({4, 4, 4}));
  EXPECT_THROW(finder.find_contacts({2, 1, true, true}), CutoffTooLarge);
  EXPECT_EQ(finder.find_contacts({}).size(), 1U);
  EXPECT_THROW(finder.update(std::vector<Vec3>{{0, 0, 0}}, Box::none()), InvalidParameter);
  EXPECT_THROW(finder.update(std::vector<Vec3>{{0, 0, 0}, {NAN, 0, 0}, {1, 0, 0}}, Box::none()),
               InvalidPosition);
  EXPECT_THROW(finder.find_contacts({}), InvalidParameter);
}

}  // namespace

// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/shapes.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace {

using dch::Box;
using dch::CutoffTooLarge;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::any_contact;
using dch::necklace::Chains;
using dch::necklace::check_certificate;
using dch::necklace::Contact;
using dch::necklace::ContactQuery;
using dch::necklace::find_contacts;
using dch::necklace::LayeredHierarchy;
using dch::necklace::Necklace;
using dch::necklace::necklace_of;
using dch::necklace::separate;
using dch::necklace::Separation;
using dch::necklace::Shape;
using dch::necklace::Verification;
using dch::necklace::WrappedHierarchy;
using dch::test::contact_oracle;
using dch::test::message_of;
using testing::HasSubstr;

WrappedHierarchy wrapped_of(const Shape& shape, double radius, int leaf_beads = 1) {
  WrappedHierarchy hierarchy(necklace_of(shape, radius), {leaf_beads, Verification::cascade});
  hierarchy.build(shape.positions, Box::none());
  return hierarchy;
}

ContactQuery every_pair(double gap = 0) {
  ContactQuery query;
  query.gap = gap;
  query.skip_bonds = 0;
  return query;
}

/// Contacts, the certificate and the early-out query agree with the oracle.
void expect_right(const Shape& shape, double radius, const ContactQuery& query) {
  const auto expected = contact_oracle(necklace_of(shape, radius), shape.positions, Box::none(), query);
  for (const int leaf_beads : {1, 8}) {
    const WrappedHierarchy hierarchy = wrapped_of(shape, radius, leaf_beads);
    EXPECT_EQ(dch::test::pairs_of(find_contacts(hierarchy, query)), expected);
    EXPECT_EQ(any_contact(hierarchy, query), !expected.empty());
    const Separation separation = separate(hierarchy, query);
    EXPECT_EQ(dch::test::pairs_of(separation.contacts), expected);
    EXPECT_EQ(check_certificate(hierarchy, query, separation), "");
  }
}

TEST(Contacts, AreInOrderWhetherTheyAreFewOrManyForTheParticles) {
  // A chain whose beads are named in no order, among as many other particles as `spread` says.
  for (const std::int32_t spread : {1, 200}) {
    constexpr std::int32_t kBeads = 40;
    std::vector<std::int32_t> order;
    for (std::int32_t k = 0; k < kBeads; ++k) order.push_back((17 * k) % kBeads * spread);
    Chains chains(static_cast<std::size_t>(kBeads * spread));
    chains.add(order);
    const Necklace necklace(chains, 0.5);
    std::vector<Vec3> positions(necklace.particles());
    for (std::int32_t k = 0; k < kBeads; ++k) {
      positions[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] = {0.3 * (k % 6), 0.2 * k, 0};
    }
    WrappedHierarchy hierarchy(necklace);
    hierarchy.build(positions, Box::none());
    const auto found = dch::test::pairs_of(find_contacts(hierarchy, {}));
    EXPECT_GT(found.size(), 40U);
    EXPECT_LT(found.size(), 200U * kBeads / 8);
    EXPECT_EQ(found, contact_oracle(necklace, positions, Box::none(), {})) << "spread " << spread;
  }
}

TEST(Contacts, HardShapes) {
  expect_right(dch::necklace::grid_necklace(64, 1, 1), 0.49, every_pair());
  expect_right(dch::necklace::grid_necklace(12, 12, 1), 0.5, {});
  expect_right(dch::necklace::grid_necklace(6, 6, 6), 0.5, every_pair());
  expect_right(dch::necklace::helix(300, 3.2, 0.3, 0.05), 0.5, {0.05, 1, true, true});
  expect_right(dch::necklace::torus_knot(2, 3, 120), 0.5, {0.3, 2, true, true});
  expect_right(dch::necklace::torus_knot(3, 4, 240), 0.5, {1, 3, true, true});
  expect_right(dch::necklace::facing_bumps(60, 3, 0.4, 0.5), 0.2, {});
  expect_right(dch::necklace::facing_bumps(60, 3, 0.4, 0.5), 0.1, {});
  expect_right(dch::necklace::tight_set(8), 0.01, {});
  expect_right(dch::necklace::globule(500, 0.1, 1), 0.5, {0.1, 1, true, true});
  expect_right({std::vector<Vec3>(40, {1, 2, 3}), false}, 0.5, {});
  expect_right({std::vector<Vec3>(40, {1, 2, 3}), false}, 0, every_pair());
  expect_right({{{0, 0, 0}, {1, 0, 0}, {1e12, 0, 0}, {2, 0, 0}, {1.5, 0, 0}}, false}, 0.5, {});
}

TEST(Contacts, KnotsAndSwollenChainsHaveNone) {
  EXPECT_FALSE(any_contact(wrapped_of(dch::necklace::torus_knot(2, 3, 120), 0.5, 8), {0, 1, true, true}));
  EXPECT_FALSE(any_contact(wrapped_of(dch::necklace::torus_knot(2, 7, 300), 0.5, 8), {0, 1, true, true}));
  EXPECT_FALSE(any_contact(wrapped_of(dch::necklace::self_avoiding_walk(3000, 1, 1), 0.499, 8), {}));
}

TEST(Contacts, TouchingCountsAndJustApartDoesNot) {
  const Shape pair{{{0, 0, 0}, {5, 0, 0}, {1, 0, 0}}, false};
  EXPECT_EQ(find_contacts(wrapped_of(pair, 0.5), {}).size(), 1U);
  const Shape apart{{{0, 0, 0}, {5, 0, 0}, {1 + 1e-12, 0, 0}}, false};
  EXPECT_TRUE(find_contacts(wrapped_of(apart, 0.5), {}).empty());
  EXPECT_EQ(find_contacts(wrapped_of(apart, 0.5), {1e-11, 1, true, true}).size(), 1U);
}

TEST(Contacts, SayGapAndClosestPoints) {
  const Necklace necklace = Necklace::chain({0.5, 1, 0.25});
  WrappedHierarchy hierarchy(necklace);
  hierarchy.build(std::vector<Vec3>{{9.5, 5, 5}, {8, 5, 5}, {0.75, 5, 5}}, Box::orthorhombic({10, 10, 10}));
  const std::vector<Contact> contacts = find_contacts(hierarchy, {0.75, 1, true, true});
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].i, 0);
  EXPECT_EQ(contacts[0].j, 2);
  EXPECT_DOUBLE_EQ(contacts[0].gap, 0.5);
  EXPECT_EQ(contacts[0].on_i, (Vec3{10, 5, 5}));
  EXPECT_EQ(contacts[0].on_j, (Vec3{10.5, 5, 5}));
}

TEST(Contacts, NegativeGapAsksForOverlap) {
  const Shape shape{{{0, 0, 0}, {5, 0, 0}, {0.9, 0, 0}}, false};
  EXPECT_EQ(find_contacts(wrapped_of(shape, 0.5), {-0.05, 1, true, true}).size(), 1U);
  EXPECT_TRUE(find_contacts(wrapped_of(shape, 0.5), {-0.15, 1, true, true}).empty());
  EXPECT_TRUE(find_contacts(wrapped_of(shape, 0.5), {-2, 0, true, true}).empty());
}

TEST(Contacts, ChainsWithinAndBetween) {
  Chains chains(5);
  chains.add(std::vector<std::int32_t>{0, 1});
  chains.add(std::vector<std::int32_t>{4, 3, 2});
  WrappedHierarchy hierarchy(Necklace(chains, 0.5));
  hierarchy.build(std::vector<Vec3>(5), Box::none());
  using Pairs = std::vector<dch::IndexPair>;
  EXPECT_EQ(dch::test::pairs_of(find_contacts(hierarchy, {0, 1, true, false})), (Pairs{{2, 4}}));
  EXPECT_EQ(dch::test::pairs_of(find_contacts(hierarchy, {0, 1, false, true})),
            (Pairs{{0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}}));
  EXPECT_EQ(find_contacts(hierarchy, {0, 0, true, true}).size(), 10U);
  EXPECT_TRUE(find_contacts(hierarchy, {0, 0, false, false}).empty());
}

TEST(Contacts, LayeredHierarchyGivesTheSame) {
  const Shape walk = dch::necklace::random_walk(700, 3);
  LayeredHierarchy layered(necklace_of(walk, 0.4));
  layered.update(walk.positions, Box::none());
  EXPECT_EQ(dch::test::pairs_of(find_contacts(layered, {})),
            dch::test::pairs_of(find_contacts(wrapped_of(walk, 0.4), {})));
  EXPECT_EQ(check_certificate(layered, {}, separate(layered, {})), "");
}

TEST(Contacts, SmallestInputs) {
  for (const std::size_t n : {0U, 1U, 2U}) {
    WrappedHierarchy hierarchy(Necklace::chain(std::vector<double>(n, 0.5)));
    hierarchy.build(std::vector<Vec3>(n), Box::none());
    EXPECT_FALSE(any_contact(hierarchy, {}));
    EXPECT_EQ(any_contact(hierarchy, every_pair()), n == 2);
    EXPECT_EQ(check_certificate(hierarchy, every_pair(), separate(hierarchy, every_pair())), "");
  }
}

TEST(Contacts, RefuseBadQueries) {
  const WrappedHierarchy hierarchy = wrapped_of(dch::necklace::random_walk(9, 1), 0.5);
  const auto error = [&](const ContactQuery& query) {
    return message_of<InvalidParameter>([&] { find_contacts(hierarchy, query); });
  };
  EXPECT_THAT(error({NAN, 1, true, true}), HasSubstr("the gap is nan"));
  EXPECT_THAT(error({INFINITY, 1, true, true}), HasSubstr("the gap is inf"));
  EXPECT_THAT(error({0, -1, true, true}), HasSubstr("skip_bonds is -1"));
  const WrappedHierarchy empty(Necklace::chain({1, 1}));
  EXPECT_THAT(message_of<InvalidParameter>([&] { any_contact(empty, {}); }), HasSubstr("has no positions"));
  WrappedHierarchy boxed(Necklace::chain({1, 1}));
  boxed.build(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, Box::orthorhombic({6, 6, 6}));
  EXPECT_NO_THROW(any_contact(boxed, {1, 1, true, true}));
  EXPECT_THAT(message_of<CutoffTooLarge>([&] {
                any_contact(boxed, {1.01, 1, true, true});
              }),
              HasSubstr("is 3.010000, which exceeds half the smallest box height, 3.000000"));
}

// Beads of two cages may be able to touch in one image alone while parts of the cages, which stick out of
// them, reach each other in another one.
TEST(Certificate, CagesAreApartInEveryImage) {
  const Box box = Box::orthorhombic({6, 6, 6});
  int pairs_of_cages = 0;
  for (std::uint64_t seed = 1; seed <= 12000; ++seed) {
    dch::scenes::Random random(seed);
    std::vector<Vec3> positions;
    Vec3 at{};
    for (int k = 0; k < 8; ++k) {
      positions.push_back(at);
      Vec3 step;
      do step = random.in_ball(2.9);
      while (norm2(step) < 1);
      at = at + step;
      if (k == 3) at = at + random.in_ball(3);
    }
    Chains chains(8);
    chains.add(std::vector<std::int32_t>{0, 1, 2, 3});
    chains.add(std::vector<std::int32_t>{4, 5, 6, 7});
    WrappedHierarchy hierarchy(Necklace(chains, 0.02), {1, Verification::cascade});
    hierarchy.build(positions, box);
    const ContactQuery query = every_pair();
    const Separation separation = separate(hierarchy, query);
    ASSERT_EQ(check_certificate(hierarchy, query, separation), "") << "seed " << seed;
    EXPECT_EQ(dch::test::pairs_of(separation.contacts), dch::test::pairs_of(find_contacts(hierarchy, query)));
    for (const auto& pair : separation.pairs) pairs_of_cages += pair.a.count > 1 || pair.b.count > 1;
  }
  EXPECT_GT(pairs_of_cages, 12000);
}

TEST(Certificate, CagesThatReachEachOtherInAnotherImageAreFound) {
  WrappedHierarchy hierarchy(Necklace::chain({0.1, 0.1, 0.1, 0.1}), {1, Verification::cascade});
  hierarchy.build(std::vector<Vec3>{{0.5, 5, 5}, {2, 5, 5}, {5, 5, 5}, {9.5, 5, 5}},
                  Box::orthorhombic({10, 10, 10}));
  const ContactQuery query = every_pair();
  Separation separation = separate(hierarchy, query);
  ASSERT_EQ(check_certificate(hierarchy, query, separation), "");
  // Far apart where they are: centers at 1.25 and 9.5, radii 0.85 and 0.1; near each other across the face.
  separation.pairs = {{{0, 2, {{1.25, 5, 5}, 0.9}}, {3, 1, {{9.5, 5, 5}, 1.2}}}};
  EXPECT_THAT(check_certificate(hierarchy, query, separation), HasSubstr("is not apart"));
}

TEST(Certificate, FaultsAreFound) {
  const Shape walk = dch::necklace::self_avoiding_walk(60, 1, 3);
  const WrappedHierarchy hierarchy = wrapped_of(walk, 0.45);
  const ContactQuery query{0.3, 1, true, true};
  const Separation good = separate(hierarchy, query);
  ASSERT_FALSE(good.contacts.empty());
  ASSERT_EQ(check_certificate(hierarchy, query, good), "");
  const auto check = [&](auto spoil) {
    Separation bad = good;
    spoil(bad);
    return check_certificate(hierarchy, query, bad);
  };
  EXPECT_THAT(check([](Separation& s) { s.pairs.pop_back(); }), HasSubstr("are covered by nothing"));
  EXPECT_THAT(check([](Separation& s) { s.contacts.pop_back(); }), HasSubstr("are covered by nothing"));
  EXPECT_THAT(check([](Separation& s) { s.pairs.push_back(s.pairs[0]); }), HasSubstr("again"));
  EXPECT_THAT(check([](Separation& s) { s.contacts.push_back(s.contacts[0]); }),
              HasSubstr("in contact twice"));
  EXPECT_THAT(check([](Separation& s) { s.pairs[0].a.cage.radius *= 0.5; }), HasSubstr("lets out a bead"));
  EXPECT_THAT(check([](Separation& s) { s.pairs[0].b.cage.radius *= 1e3; }), HasSubstr("is not apart"));
  EXPECT_THAT(check([](Separation& s) { s.pairs[0].a.first = 60; }), HasSubstr("do not exist"));
}

}  // namespace

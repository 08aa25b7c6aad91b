// SPDX-License-Identifier: MIT
// Contact maps and P(s) against counting over all pairs of beads, frame by frame.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <map>
#include <string>
#include <vector>

#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contact_probability.hpp>

#include "contact_trajectory.hpp"
#include "error_message.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Contact;
using dch::necklace::ContactMap;
using dch::necklace::ContactProbability;
using dch::necklace::ContactQuery;
using dch::necklace::Necklace;
using dch::necklace::SeparationRange;
using dch::test::contact_oracle;
using dch::test::message_of;
using dch::test::random_necklace;
using dch::test::random_trajectories;
using dch::test::Standing;
using dch::test::Trajectory;
using testing::HasSubstr;

/// Contacts and pairs of each pair of bins (a <= b), over all pairs of particles.
struct MapOracle {
  std::map<IndexPair, std::int64_t> contacts, pairs;

  MapOracle(const Trajectory& trajectory, const ContactMap& map) {
    const auto particles = trajectory.beads.particle();
    std::vector<std::int32_t> bin(trajectory.beads.particles(), -1);
    for (std::size_t k = 0; k < map.bins(); ++k) {
      for (std::int32_t place = map.first_place(k); place < map.first_place(k + 1); ++place) {
        bin[std::size_t(particles[std::size_t(place)])] = std::int32_t(k);
      }
    }
    const auto count = [&](const std::vector<IndexPair>& list, std::map<IndexPair, std::int64_t>& counts) {
      for (const IndexPair& pair : list) {
        const std::int32_t a = bin[std::size_t(pair[0])], b = bin[std::size_t(pair[1])];
        ++counts[{std::min(a, b), std::max(a, b)}];
      }
    };
    for (const auto& frame : trajectory.oracle) count(frame, contacts);
    ContactQuery all = trajectory.query;
    all.gap = 1e200;
    count(contact_oracle(trajectory.beads, std::vector<Vec3>(trajectory.beads.particles()), Box::none(), all),
          pairs);
  }
};

TEST(ContactMap, EqualsCountingOverAllPairs) {
  for (const Trajectory& trajectory : random_trajectories()) {
    SCOPED_TRACE("seed " + std::to_string(trajectory.seed));
    for (const int max_bins : {1, 2, 3, 7, 20, 512}) {
      ContactMap map(trajectory.beads, trajectory.query, max_bins);
      ASSERT_LE(map.bins(), std::size_t(max_bins));
      ASSERT_EQ(std::size_t(map.first_place(map.bins())), trajectory.beads.size());
      for (const auto& contacts : trajectory.found) map.add(contacts);
      MapOracle oracle(trajectory, map);
      for (std::size_t b = 0; b < map.bins(); ++b) {
        for (std::size_t a = 0; a <= b; ++a) {
          const IndexPair bins{std::int32_t(a), std::int32_t(b)};
          ASSERT_EQ(map.contacts(a, b), oracle.contacts[bins]) << a << " " << b << " of " << map.bins();
          ASSERT_EQ(map.contacts(b, a), oracle.contacts[bins]);
          ASSERT_EQ(map.pairs(a, b), oracle.pairs[bins]) << a << " " << b << " of " << map.bins();
          ASSERT_EQ(map.pairs(b, a), oracle.pairs[bins]);
          if (oracle.pairs[bins] == 0) {
            ASSERT_TRUE(std::isnan(map.frequency(a, b)));
          } else {
            ASSERT_DOUBLE_EQ(map.frequency(a, b),
                             double(oracle.contacts[bins]) / (12 * double(oracle.pairs[bins])));
          }
        }
      }
    }
  }
}

TEST(ContactMap, CutsChainsEvenlyAndGathersMany) {
  const auto first_places = [](const std::vector<int>& lengths, int max_bins) {
    dch::scenes::Random random(3);
    const ContactMap map(random_necklace(random, lengths), {}, max_bins);
    std::vector<std::int32_t> places;
    for (std::size_t k = 0; k <= map.bins(); ++k) places.push_back(map.first_place(k));
    return places;
  };
  EXPECT_THAT(first_places({10}, 4), testing::ElementsAre(0, 2, 5, 7, 10));
  EXPECT_THAT(first_places({10, 3}, 4), testing::ElementsAre(0, 3, 6, 10, 13));
  EXPECT_THAT(first_places({2, 2}, 9), testing::ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(first_places({2, 3, 4, 5, 6}, 2), testing::ElementsAre(0, 9, 20));
  EXPECT_THAT(first_places({}, 2), testing::ElementsAre(0));
}

TEST(ContactMap, HoldsLongSkipsAndLongChains) {
  const Necklace ring = Necklace::chain(std::vector<double>(100000, 0.5), true);
  const ContactMap map(ring, {0, 2000000000, true, true}, 3);
  EXPECT_EQ(map.pairs(0, 0), 0);
  EXPECT_EQ(map.pairs(0, 2), 0);
  const ContactMap open(Necklace::chain(std::vector<double>(100000, 0.5)), {0, 1, true, true}, 1);
  EXPECT_EQ(open.pairs(0, 0), 100000LL * 99999 / 2 - 99999);
}

TEST(ContactMap, Refuses) {
  const Necklace necklace = Necklace::chain({1, 1, 1});
  const auto error = [&](const ContactQuery& query, int bins) {
    return message_of<InvalidParameter>([&] { ContactMap(necklace, query, bins); });
  };
  EXPECT_THAT(error({}, 0), HasSubstr("number of bins is 0; it has to be 1 to 16384"));
  EXPECT_THAT(error({}, 16385), HasSubstr("number of bins is 16385"));
  EXPECT_THAT(error({0, -1, true, true}, 5), HasSubstr("skip_bonds is -1"));
  ContactMap map(necklace, {});
  EXPECT_THAT(message_of<InvalidParameter>([&] {
                map.add(std::vector<Contact>{{0, 3, 0, {}, {}}});
              }),
              HasSubstr("the particle 3, which stands in no chain"));
  EXPECT_EQ(ContactMap().bins(), 0U);
}

TEST(ContactProbability, EqualsCountingOverAllPairs) {
  for (const Trajectory& trajectory : random_trajectories()) {
    SCOPED_TRACE("seed " + std::to_string(trajectory.seed));
    ContactProbability probability(trajectory.beads, trajectory.query);
    for (const auto& contacts : trajectory.found) probability.add(contacts);
    const Standing standing(trajectory.beads.chains());
    std::vector<std::int64_t> contacts(probability.contacts().size()), pairs(contacts.size());
    const auto count = [&](const std::vector<IndexPair>& list, std::vector<std::int64_t>& counts) {
      for (const auto& [i, j] : list) {
        const int chain = standing.chain[std::size_t(i)];
        if (chain != standing.chain[std::size_t(j)]) continue;
        int s = std::abs(standing.along[std::size_t(i)] - standing.along[std::size_t(j)]);
        const auto& chains = trajectory.beads.chains();
        const int beads = static_cast<int>(chains.beads(std::size_t(chain)).size());
        if (chains.closed(std::size_t(chain))) s = std::min(s, beads - s);
        ++counts.at(std::size_t(s));
      }
    };
    for (const auto& frame : trajectory.oracle) count(frame, contacts);
    ContactQuery all = trajectory.query;
    all.gap = 1e200;
    count(contact_oracle(trajectory.beads, std::vector<Vec3>(trajectory.beads.particles()), Box::none(), all),
          pairs);
    for (std::size_t s = 0; s < contacts.size(); ++s) {
      EXPECT_EQ(probability.contacts()[s], contacts[s]) << "separation " << s;
      EXPECT_EQ(probability.pairs()[s], pairs[s]) << "separation " << s;
      if (pairs[s] == 0) {
        EXPECT_TRUE(std::isnan(probability.probability(s)));
      } else {
        EXPECT_DOUBLE_EQ(probability.probability(s), double(contacts[s]) / (12 * double(pairs[s])));
      }
    }
  }
}

TEST(ContactProbability, CountsThePairsOfChainsAndRings) {
  EXPECT_THAT(ContactProbability(Necklace::chain({1, 1, 1, 1, 1}), {0, 0, true, true}).pairs(),
              testing::ElementsAre(0, 4, 3, 2, 1));
  EXPECT_THAT(ContactProbability(Necklace::chain({1, 1, 1, 1, 1}, true), {0, 1, true, true}).pairs(),
              testing::ElementsAre(0, 0, 5));
  EXPECT_THAT(ContactProbability(Necklace::chain({1, 1, 1, 1, 1, 1}, true), {0, 0, true, true}).pairs(),
              testing::ElementsAre(0, 6, 6, 3));
  EXPECT_THAT(ContactProbability(Necklace::chain({1, 1, 1}), {0, 0, false, true}).pairs(),
              testing::ElementsAre(0, 0, 0));
  EXPECT_TRUE(ContactProbability(Necklace::chain({}), {}).pairs().empty());
}

TEST(ContactProbability, GathersSeparationsInProportion) {
  const Necklace necklace = Necklace::chain(std::vector<double>(101, 0.5));
  ContactProbability probability(necklace, {0, 1, true, true});
  const std::vector<Contact> contacts{{0, 2, 0, {}, {}}, {0, 50, 0, {}, {}}, {3, 100, 0, {}, {}}};
  probability.add(contacts);
  probability.add(contacts);
  const std::vector<SeparationRange> ranges = probability.ranges(1);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[0].first, 2);
  EXPECT_EQ(ranges[0].last, 19);
  EXPECT_EQ(ranges[0].contacts, 2);
  EXPECT_EQ(ranges[0].pairs, (101 - 2 + 101 - 19) * 18 / 2);
  EXPECT_EQ(ranges[1].first, 20);
  EXPECT_EQ(ranges[1].last, 100);
  EXPECT_DOUBLE_EQ(ranges[1].probability, 4.0 / (2 * (81 + 1) * 81 / 2));
  EXPECT_EQ(probability.ranges(1000).size(), 99U);
  EXPECT_THAT(message_of<InvalidParameter>([&] { probability.ranges(0); }),
              HasSubstr("ranges a decade is 0; it has to be 1 to 1000"));
}

TEST(ContactProbability, Refuses) {
  EXPECT_THAT(message_of<InvalidParameter>([] {
                ContactProbability(Necklace::chain({1, 1}), {0, -3, true, true});
              }),
              HasSubstr("skip_bonds is -3"));
  ContactProbability probability(Necklace::chain({1, 1}), {});
  EXPECT_THAT(message_of<InvalidParameter>([&] {
                probability.add(std::vector<Contact>{{-1, 1, 0, {}, {}}});
              }),
              HasSubstr("the particle -1"));
}

}  // namespace

// SPDX-License-Identifier: MIT
// Events, maps and P(s) against counting over all pairs of beads, frame by frame.
#include <cmath>
#include <gmock/gmock.h>
#include <map>
#include <string>
#include <vector>

#include <dch/necklace/contact_events.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contact_probability.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "error_message.hpp"
#include "random.hpp"

namespace {

using dch::Box;
using dch::IndexPair;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::Contact;
using dch::necklace::ContactEvent;
using dch::necklace::ContactEvents;
using dch::necklace::ContactMap;
using dch::necklace::ContactProbability;
using dch::necklace::ContactQuery;
using dch::necklace::find_contacts;
using dch::necklace::Necklace;
using dch::necklace::SeparationRange;
using dch::necklace::WrappedHierarchy;
using dch::test::contact_oracle;
using dch::test::message_of;
using dch::test::Standing;
using testing::HasSubstr;

/// Chains in a box, some of them rings, with solvent between, and the pairs in contact in each frame.
struct Trajectory {
  Necklace necklace;
  ContactQuery query;
  std::vector<double> times;
  std::vector<std::vector<Contact>> found;     ///< by the wrapped hierarchy
  std::vector<std::vector<IndexPair>> oracle;  ///< by all pairs
};

Necklace random_necklace(dch::scenes::Random& random, const std::vector<int>& lengths) {
  std::vector<std::int32_t> order;
  for (const int length : lengths) {
    for (int k = 0; k < length + 1; ++k) order.push_back(static_cast<std::int32_t>(order.size()));
  }
  random.shuffle(order);
  Chains chains(order.size());
  auto next = order.data();
  for (const int length : lengths) {
    chains.add({next, static_cast<std::size_t>(length)}, length >= 3 && random.below(2) == 0);
    next += length + 1;  // one particle is solvent
  }
  std::vector<double> radii;
  for (std::size_t k = 0; k < order.size(); ++k) radii.push_back(random.uniform(0.2, 0.5));
  return {chains, radii};
}

Trajectory random_trajectory(std::uint64_t seed, const std::vector<int>& lengths, const ContactQuery& query) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  dch::scenes::Random random(seed);
  Trajectory result{random_necklace(random, lengths), query, {}, {}, {}};
  const Box box = Box::orthorhombic({10, 10, 10});
  std::vector<Vec3> positions(result.necklace.particles());
  for (Vec3& p : positions) p = random.in_ball(2.2);  // bonds stay below half the box
  WrappedHierarchy hierarchy(result.necklace);
  for (int frame = 0; frame < 12; ++frame) {
    result.times.push_back(frame == 0 ? 5 : result.times.back() + random.uniform(0, 2));
    hierarchy.update(positions, box);
    result.found.push_back(find_contacts(hierarchy, query));
    result.oracle.push_back(contact_oracle(result.necklace, positions, box, query));
    for (Vec3& p : positions) p = 0.9 * (p + random.in_ball(0.2));
    if (frame == 5) {
      for (Vec3& p : positions) p = 1.5 * p;
    }
  }
  return result;
}

std::vector<Trajectory> random_trajectories() {
  std::vector<Trajectory> result;
  std::uint64_t seed = 1;
  for (const ContactQuery& query : {ContactQuery{0.1, 1, true, true}, ContactQuery{0.3, 3, true, false},
                                    ContactQuery{0, 0, false, true}, ContactQuery{0.2, 0, true, true}}) {
    for (const std::vector<int>& lengths :
         std::vector<std::vector<int>>{{40}, {1, 2, 3, 4, 17}, {12, 12, 12}, {6, 3, 9, 30}, {7}}) {
      result.push_back(random_trajectory(seed++, lengths, query));
    }
  }
  return result;
}

bool contains(const std::vector<IndexPair>& pairs, IndexPair pair) {
  return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

/// Events by looking at the frames of each pair of particles.
std::vector<ContactEvent> events_oracle(const Trajectory& trajectory) {
  std::vector<ContactEvent> events;
  const auto particles = static_cast<std::int32_t>(trajectory.necklace.particles());
  const std::size_t frames = trajectory.times.size();
  for (std::int32_t i = 0; i < particles; ++i) {
    for (std::int32_t j = i + 1; j < particles; ++j) {
      for (std::size_t k = 0; k < frames; ++k) {
        if (!contains(trajectory.oracle[k], {i, j})) continue;
        std::size_t end = k;
        while (end < frames && contains(trajectory.oracle[end], {i, j})) ++end;
        events.push_back({i, j, static_cast<std::int64_t>(k), static_cast<std::int64_t>(end - k),
                          trajectory.times[k], trajectory.times[end - 1], k == 0, end == frames});
        k = end;
      }
    }
  }
  return events;
}

std::string text(const ContactEvent& e) {
  return std::to_string(e.i) + "-" + std::to_string(e.j) + " frames " + std::to_string(e.first) + "+" +
         std::to_string(e.frames) + " times " + std::to_string(e.begin) + " to " + std::to_string(e.last) +
         (e.begun_before ? " begun before" : "") + (e.not_ended ? " not ended" : "");
}

std::vector<std::string> sorted_texts(std::vector<ContactEvent> events) {
  std::sort(events.begin(), events.end(), [](const ContactEvent& a, const ContactEvent& b) {
    return std::array<std::int64_t, 3>{a.i, a.j, a.first} < std::array<std::int64_t, 3>{b.i, b.j, b.first};
  });
  std::vector<std::string> texts;
  for (const ContactEvent& event : events) texts.push_back(text(event));
  return texts;
}

TEST(ContactEvents, EqualThoseOfEachPairOfParticles) {
  std::size_t events_seen = 0;
  for (const Trajectory& trajectory : random_trajectories()) {
    ContactEvents events;
    std::vector<ContactEvent> all;
    for (std::size_t k = 0; k < trajectory.times.size(); ++k) {
      const auto ended = events.add(trajectory.times[k], trajectory.found[k]);
      for (const ContactEvent& event : ended) EXPECT_EQ(event.first + event.frames, std::int64_t(k));
      all.insert(all.end(), ended.begin(), ended.end());
      EXPECT_EQ(events.running(), trajectory.found[k].size());
    }
    EXPECT_EQ(events.frames(), std::int64_t(trajectory.times.size()));
    const auto last = events.finish();
    all.insert(all.end(), last.begin(), last.end());
    EXPECT_EQ(sorted_texts(all), sorted_texts(events_oracle(trajectory)));
    EXPECT_EQ(events.frames(), 0);
    events_seen += all.size();
  }
  EXPECT_GT(events_seen, 1000U);
}

TEST(ContactEvents, SayHowLong) {
  ContactEvents events;
  const std::vector<Contact> pair{{3, 8, 0, {}, {}}};
  EXPECT_TRUE(events.add(1, {}).empty());
  EXPECT_TRUE(events.add(2, pair).empty());
  EXPECT_TRUE(events.add(4.5, pair).empty());
  const auto ended = events.add(4.5, {});
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(text(ended[0]), "3-8 frames 1+2 times 2.000000 to 4.500000");
  EXPECT_EQ(ended[0].duration(), 2.5);
  EXPECT_TRUE(events.finish().empty());
  EXPECT_TRUE(events.add(-7, pair).empty()) << "after finish() time starts anew";
}

TEST(ContactEvents, RefuseFramesOutOfOrder) {
  ContactEvents events;
  events.add(3, {});
  const std::vector<Contact> twice{{1, 2, 0, {}, {}}, {1, 2, 0, {}, {}}}, turned{{2, 1, 0, {}, {}}},
      down{{1, 3, 0, {}, {}}, {1, 2, 0, {}, {}}};
  const auto error = [&](double time, const std::vector<Contact>& contacts) {
    return message_of<InvalidParameter>([&] { events.add(time, contacts); });
  };
  EXPECT_THAT(error(2, {}), HasSubstr("2.000000, below that of the frame before, 3.000000"));
  EXPECT_THAT(error(NAN, {}), HasSubstr("the time is nan"));
  EXPECT_THAT(error(3, twice), HasSubstr("contact 1, of the beads 1 and 2, is out of order"));
  EXPECT_THAT(error(3, turned), HasSubstr("contact 0, of the beads 2 and 1, is out of order"));
  EXPECT_THAT(error(3, down), HasSubstr("contact 1"));
  EXPECT_EQ(events.frames(), 1);
}

/// Contacts and pairs of each pair of bins (a <= b), over all pairs of particles.
struct MapOracle {
  std::map<IndexPair, std::int64_t> contacts, pairs;

  MapOracle(const Trajectory& trajectory, const ContactMap& map) {
    const auto particles = trajectory.necklace.particle();
    std::vector<std::int32_t> bin(trajectory.necklace.particles(), -1);
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
    count(contact_oracle(trajectory.necklace, std::vector<Vec3>(trajectory.necklace.particles()), Box::none(),
                         all),
          pairs);
  }
};

TEST(ContactMap, EqualsCountingOverAllPairs) {
  for (const Trajectory& trajectory : random_trajectories()) {
    for (const int max_bins : {1, 2, 3, 7, 20, 512}) {
      ContactMap map(trajectory.necklace, trajectory.query, max_bins);
      ASSERT_LE(map.bins(), std::size_t(max_bins));
      ASSERT_EQ(std::size_t(map.first_place(map.bins())), trajectory.necklace.size());
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
    ContactProbability probability(trajectory.necklace, trajectory.query);
    for (const auto& contacts : trajectory.found) probability.add(contacts);
    const Standing standing(trajectory.necklace.chains());
    std::vector<std::int64_t> contacts(probability.contacts().size()), pairs(contacts.size());
    const auto count = [&](const std::vector<IndexPair>& list, std::vector<std::int64_t>& counts) {
      for (const auto& [i, j] : list) {
        const int chain = standing.chain[std::size_t(i)];
        if (chain != standing.chain[std::size_t(j)]) continue;
        int s = std::abs(standing.along[std::size_t(i)] - standing.along[std::size_t(j)]);
        const auto& chains = trajectory.necklace.chains();
        const int beads = static_cast<int>(chains.beads(std::size_t(chain)).size());
        if (chains.closed(std::size_t(chain))) s = std::min(s, beads - s);
        ++counts.at(std::size_t(s));
      }
    };
    for (const auto& frame : trajectory.oracle) count(frame, contacts);
    ContactQuery all = trajectory.query;
    all.gap = 1e200;
    count(contact_oracle(trajectory.necklace, std::vector<Vec3>(trajectory.necklace.particles()), Box::none(),
                         all),
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

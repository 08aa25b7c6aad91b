// SPDX-License-Identifier: MIT
//
// What is counted of contacts stays as it was if memory runs out, and what is made is made whole or not at
// all.
#include <cmath>
#include <sstream>

#include <dch/forces/fene.hpp>
#include <dch/necklace/contact_events.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contact_probability.hpp>
#include <dch/necklace/melt.hpp>
#include <dch/necklace/walks.hpp>

#include "sweep.hpp"

namespace dch::faults {
namespace {

using namespace necklace;  // NOLINT(google-build-using-namespace)

const Necklace& necklace_of_two() {
  static const Necklace chains(Chains::from_molecules(std::vector<std::int32_t>{1, 1, 1, 1, 1, 2, 2, 2, 2}),
                               0.5);
  return chains;
}

Contact contact(std::int32_t i, std::int32_t j) {
  Contact found;
  found.i = i;
  found.j = j;
  return found;
}

const std::vector<Contact> kFirst{contact(0, 2), contact(0, 3), contact(1, 3), contact(5, 7)};
const std::vector<Contact> kSecond{contact(0, 4), contact(1, 3), contact(1, 4),
                                   contact(2, 4), contact(3, 6), contact(5, 8)};

std::string text_of(Span<const ContactEvent> events) {
  std::ostringstream text;
  for (const ContactEvent& e : events)
    text << e.i << ' ' << e.j << ' ' << e.first << ' ' << e.frames << ' ' << e.begin << ' ' << e.last << ' '
         << e.begun_before << e.not_ended << '\n';
  return text.str();
}

ContactEvents begun() {
  ContactEvents events;
  events.add(1, kFirst);
  return events;
}

TEST(AnalysisFaults, EventsTakeAFrameOnceMore) {
  ContactEvents whole = begun();
  const std::string ended = text_of(whole.add(2, kSecond)), running = text_of(whole.finish());
  expect_sound(sweep(
                   begun, [](ContactEvents& events) { events.add(2, kSecond); },
                   [&](ContactEvents& events, Ending ending) -> std::string {
                     if (ending == Ending::threw) {
                       if (events.frames() != 1 || events.running() != kFirst.size())
                         return "a frame was taken in part";
                       if (text_of(events.add(2, kSecond)) != ended) return "other contacts ended";
                     }
                     return text_of(events.finish()) == running ? "" : "other contacts are running";
                   }),
               2);
}

TEST(AnalysisFaults, EventsThatEndTakeNoMemory) {
  const std::string expected = text_of(begun().finish());
  expect_no_memory(sweep(
      begun, [](ContactEvents& events) { events.finish(); },
      [](ContactEvents& events, Ending) -> std::string {
        return events.frames() == 0 && events.running() == 0 ? "" : "it is not as new";
      }));
  ASSERT_FALSE(expected.empty());
}

TEST(AnalysisFaults, AMapIsMadeOrNotAndCountsWithoutMemory) {
  const ContactQuery query{0, 1, true, true};
  for (const std::int32_t bins : {4, 1}) {
    expect_sound(sweep([] { return ContactMap(); },
                       [&](ContactMap& map) { map = ContactMap(necklace_of_two(), query, bins); },
                       [&](const ContactMap& map, Ending ending) -> std::string {
                         const bool is_made = map.bins() > 0;
                         return is_made == (ending == Ending::returned) ? "" : "it is made in part";
                       }),
                 8);
    const ContactMap made(necklace_of_two(), query, bins);
    expect_no_memory(sweep([&] { return made; }, [](ContactMap& map) { map.add(kFirst); },
                           [](const ContactMap& map, Ending) {
                             return std::string(map.frames() == 1 ? "" : "a frame is not counted");
                           }));
  }
}

TEST(AnalysisFaults, ProbabilitiesAreMadeOrNotAndCountWithoutMemory) {
  const ContactQuery query{0, 1, true, true};
  expect_sound(sweep([] { return ContactProbability(); },
                     [&](ContactProbability& made) { made = ContactProbability(necklace_of_two(), query); },
                     [](const ContactProbability& made, Ending ending) -> std::string {
                       const bool is_made = made.pairs().size() > 0;
                       return is_made == (ending == Ending::returned) ? "" : "it is made in part";
                     }),
               8);
  const ContactProbability made(necklace_of_two(), query);
  const auto with_a_frame = [&] {
    ContactProbability counted = made;
    counted.add(kFirst);
    return counted;
  };
  expect_no_memory(sweep([&] { return made; }, [](ContactProbability& counted) { counted.add(kFirst); },
                         [](const ContactProbability& counted, Ending) {
                           return std::string(counted.frames() == 1 ? "" : "a frame is not counted");
                         }));
  const std::size_t ranges = with_a_frame().ranges(5).size();
  expect_sound(sweep(
                   with_a_frame, [](ContactProbability& counted) { counted.ranges(5); },
                   [&](const ContactProbability& counted, Ending) {
                     return std::string(counted.ranges(5).size() == ranges ? "" : "there are other ranges");
                   }),
               2);
}

TEST(AnalysisFaults, ChainsAreMadeWholeOrNot) {
  const Box box = Box::orthorhombic({5, 5, 5});
  std::vector<Vec3> wrapped;
  for (int k = 0; k < 9; ++k) wrapped.push_back(box.wrap({0.9 * k, 1, 1}));
  using Positions = std::vector<Vec3>;
  const Positions expected = unwrap(necklace_of_two().chains(), wrapped, box);
  expect_sound(sweep([] { return Positions(); },
                     [&](Positions& whole) { whole = unwrap(necklace_of_two().chains(), wrapped, box); },
                     [&](const Positions& whole, Ending ending) {
                       const bool is_right = ending == Ending::threw ? whole.empty() : whole == expected;
                       return std::string(is_right ? "" : "there are other positions");
                     }),
               2);
}

TEST(AnalysisFaults, AMeltIsMadeOrNot) {
  MeltParams params;
  params.chains = 4;
  params.beads_per_chain = 20;
  const necklace::Melt expected = make_melt(params);
  expect_sound(sweep([] { return necklace::Melt(); }, [&](necklace::Melt& melt) { melt = make_melt(params); },
                     [&](const necklace::Melt& melt, Ending ending) {
                       const bool is_right =
                           ending == Ending::threw
                               ? melt.positions.empty() && melt.bonds.empty()
                               : melt.positions == expected.positions && melt.bonds == expected.bonds;
                       return std::string(is_right ? "" : "it is made in part");
                     }),
               8);
}

/// Forces of a chain with a bond that is too long, which is what memory is taken for.
struct Pulled {
  std::vector<Vec3> forces = std::vector<Vec3>(4);
  std::vector<std::int32_t> too_long = {};
};

TEST(AnalysisFaults, FeneForcesAreAddedWholeOrNot) {
  const std::vector<FeneBond> types{{30, 1.5, 1, 1}};
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}};
  const std::vector<BondOfType> bonds{{0, 1, 1}, {1, 2, 1}, {2, 3, 1}};
  expect_sound(sweep([] { return 0; }, [&](int) { FeneForces forces(types); },
                     [](int, Ending) { return std::string(); }),
               2);
  const FeneForces fene(types);
  const auto add = [&](Pulled& pulled) {
    fene.add_forces(bonds, 1, positions, pulled.forces, pulled.too_long);
  };
  Pulled expected;
  add(expected);
  ASSERT_EQ(expected.too_long, (std::vector<std::int32_t>{2}));
  expect_sound(sweep([] { return Pulled(); }, add,
                     [&](Pulled& pulled, Ending ending) -> std::string {
                       if (ending == Ending::threw) {
                         if (pulled.forces != Pulled().forces) return "forces were added in part";
                         add(pulled);
                       }
                       return pulled.forces == expected.forces && pulled.too_long == expected.too_long
                                  ? ""
                                  : "forces are others";
                     }),
               2);
}

}  // namespace
}  // namespace dch::faults

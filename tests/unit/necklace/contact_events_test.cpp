// SPDX-License-Identifier: MIT
// Events against looking at the frames of each pair of beads.
#include <algorithm>
#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <dch/necklace/contact_events.hpp>

#include "contact_trajectory.hpp"
#include "error_message.hpp"

namespace {

using dch::IndexPair;
using dch::InvalidParameter;
using dch::necklace::Contact;
using dch::necklace::ContactEvent;
using dch::necklace::ContactEvents;
using dch::test::message_of;
using dch::test::random_trajectories;
using dch::test::Trajectory;
using testing::HasSubstr;

bool contains(const std::vector<IndexPair>& pairs, IndexPair pair) {
  return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
}

/// Events by looking at the frames of each pair of particles.
std::vector<ContactEvent> events_oracle(const Trajectory& trajectory) {
  std::vector<ContactEvent> events;
  const auto particles = static_cast<std::int32_t>(trajectory.beads.particles());
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
    SCOPED_TRACE("seed " + std::to_string(trajectory.seed));
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

}  // namespace

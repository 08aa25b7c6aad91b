// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <utility>
#include <vector>

#include <dch/kinetic/contacts_between.hpp>
#include <dch/lists/all_pairs.hpp>

#include "list_params.hpp"

namespace dch::kinetic {

using PairOfPoints = std::pair<std::int32_t, std::int32_t>;

/// How often each pair is shown by the list of a frame: once at most.
inline std::map<PairOfPoints, int> shown_pairs(double cutoff, const std::vector<Vec3>& positions,
                                               const Box& box) {
  std::map<PairOfPoints, int> pairs;
  const NeighborList list = all_pairs(positions, box, within(cutoff));
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t j : list.row(i)) pairs[{static_cast<std::int32_t>(i), j}] = 1;
  return pairs;
}

/// Compares contacts with all pairs: hidden ones with the oracle, those that come and go with the lists of
/// both frames. Returns how many are hidden.
inline std::size_t check_contacts_between(const PassingContacts& found, double cutoff, double slack,
                                          const std::vector<Vec3>& before, const Box& box_before,
                                          const std::vector<Vec3>& after, const Box& box_after) {
  auto then = shown_pairs(cutoff, before, box_before), now = shown_pairs(cutoff, after, box_after);
  std::vector<bool> is_left_out(before.size(), false);
  for (const std::int32_t id : found.undetermined_points) is_left_out[static_cast<std::size_t>(id)] = true;
  std::map<PairOfPoints, std::vector<PassingContact>> hidden;
  std::size_t count = 0;
  for (const PassingContact& contact : found.contacts) {
    EXPECT_LT(contact.i, contact.j);
    EXPECT_LE(0, contact.enters);
    EXPECT_LE(contact.enters, contact.leaves);
    EXPECT_LE(contact.leaves, 1);
    EXPECT_LE(contact.closest, cutoff + slack);
    EXPECT_FALSE(is_left_out[static_cast<std::size_t>(contact.i)]);
    EXPECT_FALSE(is_left_out[static_cast<std::size_t>(contact.j)]);
    const PairOfPoints pair{contact.i, contact.j};
    if (contact.is_hidden()) {
      hidden[pair].push_back(contact);
      ++count;
      continue;
    }
    EXPECT_FALSE(contact.is_shown_before && contact.is_shown_after);
    EXPECT_EQ(contact.is_shown_before ? contact.enters : 1 - contact.leaves, 0);
    auto& frame = contact.is_shown_before ? then : now;
    EXPECT_EQ(frame[pair], 1) << contact.i << ", " << contact.j;
    frame[pair] = 2;
  }
  // A pair that one frame alone shows comes or goes.
  for (const auto& [shown, other] : {std::pair(&then, &now), std::pair(&now, &then)}) {
    for (const auto& [pair, times] : *shown) {
      if (is_left_out[static_cast<std::size_t>(pair.first)] ||
          is_left_out[static_cast<std::size_t>(pair.second)])
        continue;
      if (other->contains(pair)) continue;
      EXPECT_EQ(times, 2) << pair.first << ", " << pair.second;
    }
  }
  const auto expected =
      all_hidden_contacts(cutoff, slack, before, box_before, after, box_after, found.undetermined_points);
  std::map<PairOfPoints, std::vector<OracleContact>> wanted;
  for (const OracleContact& contact : expected) {
    wanted[{contact.i, contact.j}].push_back(contact);
    if (contact.margin <= slack) continue;
    bool is_found = false;
    for (const PassingContact& other : hidden[{contact.i, contact.j}]) {
      is_found = is_found || (std::abs(other.enters - contact.enters) < 1e-5 &&
                              std::abs(other.leaves - contact.leaves) < 1e-5 &&
                              std::abs(other.closest - contact.closest) < 10 * slack);
    }
    EXPECT_TRUE(is_found) << contact.i << ", " << contact.j << ", as close as " << contact.closest << " from "
                          << contact.enters << " to " << contact.leaves;
  }
  for (const auto& [pair, contacts] : hidden)
    EXPECT_LE(contacts.size(), wanted[pair].size())
        << pair.first << ", " << pair.second << " have no contact";
  return count;
}

}  // namespace dch::kinetic

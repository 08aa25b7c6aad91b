// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engines/between_contact.hpp"

namespace dch::cli {

/// What happens between two successive frames.
struct IntervalRecord {
  std::int64_t frame = 0, next_frame = 0;  ///< indices in the file, from 0
  std::string undetermined;                ///< why nothing is known of it; empty: it was followed
  std::int64_t hidden = 0;                 ///< contacts that no frame shows
  std::int64_t come = 0, go = 0;        ///< contacts that the later frame alone shows, and the earlier alone
  std::int64_t undetermined_atoms = 0;  ///< moved half a box or more, and left out
  std::int64_t unmatched_atoms = 0;     ///< in one of the frames alone, and left out
  std::int64_t candidates = 0;          ///< pairs that were looked at
  std::optional<double> closest;        ///< least distance of the hidden contacts [length]
  double ms = 0;                        ///< wall clock

  /// Contacts that begin or end.
  std::int64_t events() const { return 2 * hidden + come + go; }
};

/// All that --continuous found.
struct BetweenReport {
  struct Closest : BetweenContact {
    std::int64_t frame, next_frame;
  };
  /// Hidden contacts by percent: k <= value < k + 1.
  using Histogram = std::array<std::int64_t, 100>;

  std::vector<IntervalRecord> intervals;
  std::optional<Closest> closest;  ///< the hidden contact of the least distance, and the first of those
  Histogram distances{};           ///< least distances, as a share of the cutoff
  Histogram durations{};           ///< as a share of the time between frames

  void add(IntervalRecord record, const std::vector<BetweenContact>& contacts, double cutoff);
  /// Sums of counts and times over the intervals; nothing else of the record has a meaning.
  IntervalRecord totals() const;
  /// Intervals of which something is known.
  std::int64_t followed() const;
};

}  // namespace dch::cli

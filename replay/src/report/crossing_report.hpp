// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dch/necklace/crossings.hpp>

#include "input/trajectory_summary.hpp"
#include "report/report_rows.hpp"

namespace dch::cli {

/// The step to one frame from the one before it. Times in milliseconds of wall clock.
struct CrossingFrame {
  std::int64_t frame = 0;  ///< index in the file, from 0
  std::int64_t step = 0;
  std::optional<double> time;  ///< in the file's unit
  std::int64_t crossings = 0, contacts = 0, undetermined = 0;
  double read_ms = 0, search_ms = 0;
};

/// A crossing, by the ids of the atoms.
struct CrossingEvent {
  std::int64_t frame = 0;  ///< the later of the two
  std::array<std::int64_t, 2> p{}, q{};
  necklace::Crossing crossing;
};

/// The first bond that a frame leaves undetermined.
struct UndeterminedEvent {
  std::int64_t frame = 0;
  std::array<std::int64_t, 2> bond{};
  necklace::UndeterminedBond::Reason reason{};
};

/// All that `dchmd crossings` found; its table, JSON and page show nothing else.
struct CrossingReport : TrajectorySummary {
  /// So many events are kept for table, JSON and page; the data file has all.
  static constexpr std::size_t kKeptEvents = 10000;

  std::string topology;
  std::int64_t chains = 0, rings = 0, beads = 0, bonds = 0;
  double thickness = 0;  ///< [length]
  std::vector<CrossingFrame> frames;
  std::vector<CrossingEvent> events;  ///< the first kKeptEvents
  std::optional<UndeterminedEvent> first_undetermined;
  std::int64_t crossings = 0, contacts = 0, undetermined = 0;  ///< over all frames
  std::int64_t positive = 0, negative = 0;                     ///< crossings by sign
  necklace::CrossingStats stats;
  int threads = 1;
  double scan_ms = 0, write_ms = 0, total_ms = 0;

  double search_ms() const;
};

/// The final table, on the terminal and on the page.
std::vector<Row> crossing_rows(const CrossingReport& report);
/// Reason in words, as they follow the bond.
std::string reason_text(necklace::UndeterminedBond::Reason reason);

/// report.json of crossings, as docs/report-schema.md describes it.
std::string render_json(const CrossingReport& report);
/// One page that needs nothing from outside.
std::string render_html(const CrossingReport& report);
/// The table at the end of a run.
std::string render_table(const CrossingReport& report);

}  // namespace dch::cli

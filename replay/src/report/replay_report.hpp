// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "engines/engine.hpp"
#include "engines/verifier.hpp"
#include "input/trajectory_summary.hpp"
#include "report/between_report.hpp"

namespace dch::cli {

/// One replayed frame. Times in milliseconds of wall clock.
struct FrameRecord {
  std::int64_t frame = 0;  ///< index in the file, from 0
  std::int64_t step = 0;
  std::int64_t atoms = 0;
  std::optional<double> time;  ///< in the file's unit
  std::int64_t pairs = 0;      ///< in the list
  bool list_rebuilt = true;
  std::int64_t refreshes = 0, repairs = 0, rebuilds = 0, promotions = 0, demotions = 0;
  int levels = 0;
  double read_ms = 0, maintain_ms = 0, list_ms = 0;
};

/// Sums over the frames.
struct ReplayTotals {
  std::int64_t pairs_min = 0, pairs_max = 0;
  double pairs_mean = 0;
  std::int64_t list_rebuilds = 0;
  std::int64_t refreshes = 0, repairs = 0, rebuilds = 0, promotions = 0, demotions = 0;
  double read_ms = 0, maintain_ms = 0, list_ms = 0;
};

/// Pairs that the list leaves out in the first frame, and the bonds they follow from.
struct ExclusionRecord {
  std::string rule;    ///< "1-2", "1-3", "1-4"; empty if nothing is excluded
  std::string source;  ///< of the bonds; empty if no topology was read
  std::int64_t bonds = 0;
  std::int64_t pairs = 0;
};

/// All that a replay found; the table, report.json and report.html show nothing else.
struct ReplayReport : TrajectorySummary {
  double cutoff = 0, skin = 0;  ///< [length]
  ListKind list_kind = ListKind::half;
  EngineOptions engine;
  std::string choice;  ///< PairSearch::choice() after the last frame
  int threads = 1;     ///< that the engine worked with
  ExclusionRecord exclusions;
  std::vector<FrameRecord> frames;
  std::vector<LevelInfo> levels;               ///< after the last frame; dch only
  std::vector<std::int64_t> degree_histogram;  ///< [k]: atoms with k neighbors, summed over the frames
  std::uint64_t list_hash = 0;                 ///< of all lists, the same for all engines
  double scan_ms = 0, verify_ms = 0, write_ms = 0, total_ms = 0;
  VerifyResult verify;
  std::optional<BetweenReport> between;  ///< if it was asked for

  ReplayTotals totals() const;
};

std::string to_string(ListKind kind);  ///< "half", "full"

/// report.json, as docs/report-schema.md describes it.
std::string render_json(const ReplayReport& report);
/// report.html: one page that needs nothing from outside.
std::string render_html(const ReplayReport& report);
/// The table at the end of a run.
std::string render_table(const ReplayReport& report);

}  // namespace dch::cli

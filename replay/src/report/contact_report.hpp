// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dch/necklace/contact_events.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contact_probability.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "input/trajectory_summary.hpp"

namespace dch::cli {

/// Contacts of one frame. Times in milliseconds of wall clock.
struct ContactFrame {
  std::int64_t frame = 0;  ///< index in the file, from 0
  std::int64_t step = 0;
  std::optional<double> time;            ///< in the file's unit
  std::int64_t within = 0, between = 0;  ///< contacts within a chain and between two
  double read_ms = 0, update_ms = 0, search_ms = 0;
  double follow_ms = 0;                                   ///< events, map and P(s)
  necklace::Structure by = necklace::Structure::wrapped;  ///< what found the contacts

  std::int64_t contacts() const { return within + between; }
};

/// What is kept of the events, which are too many to keep themselves.
class EventSummary {
 public:
  void add(Span<const necklace::ContactEvent> events);

  std::int64_t events() const { return events_; }
  std::int64_t begun_before() const { return begun_before_; }
  std::int64_t not_ended() const { return not_ended_; }
  /// Events that began and ended within the frames, so that how long they lasted is known.
  std::int64_t complete() const { return complete_; }
  /// Mean duration of those; 0 without one [time].
  double mean_duration() const { return complete_ == 0 ? 0 : duration_ / static_cast<double>(complete_); }
  /// The longest, complete or not [time].
  double longest() const { return longest_; }
  /// [k]: complete events of k frames.
  const std::vector<std::int64_t>& by_frames() const { return by_frames_; }

 private:
  std::int64_t events_ = 0, begun_before_ = 0, not_ended_ = 0, complete_ = 0;
  double duration_ = 0, longest_ = 0;
  std::vector<std::int64_t> by_frames_;
};

/// Least, mean and most of a number over the frames.
struct FrameSpread {
  std::int64_t least = 0, most = 0;
  double mean = 0;
};

/// All that `dchmd contacts` found; its table, JSON and page show nothing else.
struct ContactReport : TrajectorySummary {
  std::string topology;
  bool has_times = false;  ///< events are timed by the frames' times; else by their time steps
  std::int64_t chains = 0, rings = 0, beads = 0, shortest_chain = 0, longest_chain = 0;
  double smallest_radius = 0, largest_radius = 0;  ///< [length]
  necklace::ContactQuery query;
  std::vector<ContactFrame> frames;
  EventSummary events;
  necklace::ContactMap map;
  necklace::ContactProbability probability;
  std::vector<std::int32_t> chain_ends;  ///< first places of the chains, and the number of places
  necklace::StructureChoice choice;      ///< for a frame after the last one
  necklace::WrappedStats structure;
  std::int64_t cages = 0;
  int threads = 1;  ///< that contacts were found with
  double scan_ms = 0, write_ms = 0, total_ms = 0;

  /// Of ContactFrame::contacts.
  FrameSpread contacts() const;
  /// Frames whose contacts this structure found.
  std::int64_t frames_by(necklace::Structure which) const;
};

/// "all", "within" or "between": the pairs of beads that a query is for.
std::string pairs_text(const necklace::ContactQuery& query);

/// Ranges of separations a decade, in drawings and in JSON.
constexpr int kRangesPerDecade = 10;

/// report.json of contacts, as docs/report-schema.md describes it.
std::string render_json(const ContactReport& report);
/// One page that needs nothing from outside.
std::string render_html(const ContactReport& report);
/// The table at the end of a run.
std::string render_table(const ContactReport& report);

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "analysis/crossing_analysis.hpp"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

#include <dch/base/executor.hpp>
#include <dch/trajectory/file_error.hpp>

#include "base/exit_code.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "input/frame_stream.hpp"
#include "report/crossing_file.hpp"

namespace dch::cli {
namespace {

/// One run: what is found out beforehand, and the state that goes through the frames.
class CrossingAnalysis {
 public:
  CrossingAnalysis(const CrossingOptions& options, ProgressBar& progress)
      : options_(options), progress_(progress) {
    report_.thickness = options.thickness;
    report_.threads = options.threads;
  }

  CrossingReport run() {
    scan();
    follow_frames();
    if (data_) data_->commit();
    report_.total_ms = watch_.milliseconds();
    return std::move(report_);
  }

 private:
  void scan();
  void follow_frames();
  void follow_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms);
  necklace::StepCrossings step(const trajectory::Frame& frame, std::int64_t index);
  std::array<std::int64_t, 2> ids_of(std::int32_t bond) const;
  void take(const necklace::StepCrossings& found, CrossingFrame& record);

  const CrossingOptions& options_;
  ProgressBar& progress_;
  Stopwatch watch_;
  CrossingReport report_;
  std::int64_t frames_expected_ = 0;
  BeadChains beads_;
  std::optional<BeadFinder> finder_;
  std::unique_ptr<Executor> threads_;
  std::optional<necklace::CrossingFinder> crossings_;
  std::optional<CrossingFile> data_;
};

void CrossingAnalysis::scan() {
  const Stopwatch watch;
  const Scan scan = scan_trajectory(options_.input, options_.frames, progress_);
  report_.scan_ms = watch.milliseconds();
  static_cast<TrajectorySummary&>(report_) = scan;
  frames_expected_ = scan.frames;
  beads_ =
      read_bead_chains(options_.input.name(), options_.chains, scan.first_frame, options_.input.limits());
  finder_.emplace(options_.input.name(), beads_);
  report_.topology = beads_.source;
  report_.chains = static_cast<std::int64_t>(beads_.chains.size());
  report_.beads = static_cast<std::int64_t>(beads_.ids.size());
  for (std::size_t chain = 0; chain < beads_.chains.size(); ++chain)
    report_.rings += beads_.chains.closed(chain) ? 1 : 0;
  report_.bonds = static_cast<std::int64_t>(beads_.chains.bonds().size());
  if (!options_.data.empty()) data_.emplace(options_.data, report_);
}

void CrossingAnalysis::follow_frames() {
  FrameStream stream(options_.input, options_.frames);
  threads_ = make_threads(options_.threads);  // after the child processes, which must not inherit their locks
  necklace::CrossingFinderParams params;
  params.thickness = options_.thickness;
  params.executor = threads_.get();
  crossings_.emplace(beads_.chains, params);
  progress_.start("following bonds", frames_expected_);
  trajectory::Frame frame;
  for (std::int64_t done = 0; done < frames_expected_; ++done) {
    const Stopwatch watch;
    if (!stream.next(frame)) fail_changed(options_.input.name());
    follow_frame(frame, stream.index(), watch.milliseconds());
    progress_.advance(done + 1);
  }
  progress_.clear();
}

void CrossingAnalysis::follow_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms) {
  CrossingFrame record;
  record.frame = index;
  record.step = frame.step;
  record.time = frame.time;
  record.read_ms = read_ms;
  const Stopwatch watch;
  const necklace::StepCrossings found = step(frame, index);
  record.search_ms = watch.milliseconds();
  take(found, record);
  report_.frames.push_back(record);
}

necklace::StepCrossings CrossingAnalysis::step(const trajectory::Frame& frame, std::int64_t index) {
  const std::vector<Vec3>& positions = finder_->positions(frame, index);
  const auto place = [&](const Error& error) {
    return fmt::format("{}: frame {}: {}", options_.input.name(), index, error.what());
  };
  try {
    if (!report_.frames.empty()) return crossings_->step(positions, frame.box);
    crossings_->start(positions, frame.box);
    return {};
  } catch (const InvalidPosition& error) {
    throw trajectory::FileError(place(error));
  } catch (const InvalidBox& error) {
    throw trajectory::FileError(place(error));
  } catch (const Error& error) {
    throw UsageError(place(error));
  }
}

std::array<std::int64_t, 2> CrossingAnalysis::ids_of(std::int32_t bond) const {
  const auto [a, b] = crossings_->bonds()[static_cast<std::size_t>(bond)];
  return {beads_.ids[static_cast<std::size_t>(a)], beads_.ids[static_cast<std::size_t>(b)]};
}

void CrossingAnalysis::take(const necklace::StepCrossings& found, CrossingFrame& record) {
  record.crossings = static_cast<std::int64_t>(found.crossings.size());
  record.contacts = static_cast<std::int64_t>(found.contacts.size());
  record.undetermined = static_cast<std::int64_t>(found.undetermined.size());
  report_.crossings += record.crossings;
  report_.contacts += record.contacts;
  report_.undetermined += record.undetermined;
  report_.stats += found.stats;
  if (!found.undetermined.empty() && !report_.first_undetermined) {
    const necklace::UndeterminedBond& first = found.undetermined.front();
    report_.first_undetermined = UndeterminedEvent{record.frame, ids_of(first.bond), first.reason};
  }
  std::vector<CrossingEvent> events;
  for (const necklace::BondCrossing& crossing : found.crossings) {
    ++(crossing.sign > 0 ? report_.positive : report_.negative);
    events.push_back({record.frame, ids_of(crossing.p), ids_of(crossing.q), crossing});
    if (report_.events.size() < CrossingReport::kKeptEvents) report_.events.push_back(events.back());
  }
  if (!data_) return;
  const Stopwatch watch;
  data_->append(record, events);
  report_.write_ms += watch.milliseconds();
}

}  // namespace

CrossingReport analyze_crossings(const CrossingOptions& options, ProgressBar& progress) {
  return CrossingAnalysis(options, progress).run();
}

}  // namespace dch::cli

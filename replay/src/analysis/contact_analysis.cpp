// SPDX-License-Identifier: MIT
#include "analysis/contact_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

#include <dch/base/executor.hpp>
#include <dch/trajectory/file_error.hpp>

#include "base/exit_code.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "input/chain_topology.hpp"
#include "input/frame_stream.hpp"
#include "report/contact_file.hpp"

namespace dch::cli {
namespace {

/// One run: what is found out beforehand, and the state that goes through the frames.
class ContactAnalysis {
 public:
  ContactAnalysis(const ContactOptions& options, ProgressBar& progress)
      : options_(options), progress_(progress) {
    report_.query = options.query;
    report_.threads = options.threads;
  }
  ContactReport run();

 private:
  void scan();
  void take_chains(const Scan& scan);
  void require_gap_fits(const Scan& scan) const;
  void open_data_file();
  void follow_frames();
  void start_search();
  void follow_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms);
  std::vector<necklace::Contact> contacts_of(const trajectory::Frame& frame, std::int64_t index,
                                             ContactFrame& record);
  std::string bond_text(const necklace::Undetermined& error, const Box& box) const;
  double time_of(const trajectory::Frame& frame, std::int64_t index);
  void finish();

  const ContactOptions& options_;
  ProgressBar& progress_;
  Stopwatch watch_;
  ContactReport report_;
  std::int64_t frames_expected_ = 0;
  BeadChains beads_;
  std::optional<BeadFinder> finder_;
  std::optional<necklace::Necklace> necklace_;  ///< until start_search() hands it on
  std::unique_ptr<Executor> threads_;
  std::optional<necklace::ContactFinder> contacts_;
  necklace::ContactEvents events_;
  double last_time_ = 0;
  std::optional<ContactFile> data_;
};

ContactReport ContactAnalysis::run() {
  scan();
  follow_frames();
  finish();
  report_.total_ms = watch_.milliseconds();
  return std::move(report_);
}

void ContactAnalysis::scan() {
  const Stopwatch watch;
  const Scan scan = scan_trajectory(options_.input, options_.frames, progress_);
  report_.scan_ms = watch.milliseconds();
  static_cast<TrajectorySummary&>(report_) = scan;
  report_.has_times = scan.has_times;
  frames_expected_ = scan.frames;
  take_chains(scan);
  open_data_file();
}

void ContactAnalysis::take_chains(const Scan& scan) {
  beads_ =
      read_bead_chains(options_.input.name(), options_.chains, scan.first_frame, options_.input.limits());
  finder_.emplace(options_.input.name(), beads_);
  const std::vector<double> radii = options_.radii.of(beads_, options_.input.name());
  report_.topology = beads_.source;
  report_.chains = static_cast<std::int64_t>(beads_.chains.size());
  report_.beads = static_cast<std::int64_t>(beads_.ids.size());
  report_.smallest_radius = *std::min_element(radii.begin(), radii.end());
  report_.largest_radius = *std::max_element(radii.begin(), radii.end());
  report_.shortest_chain = report_.beads;
  for (std::size_t chain = 0; chain < beads_.chains.size(); ++chain) {
    const auto size = static_cast<std::int64_t>(beads_.chains.beads(chain).size());
    report_.shortest_chain = std::min(report_.shortest_chain, size);
    report_.longest_chain = std::max(report_.longest_chain, size);
    report_.rings += beads_.chains.closed(chain) ? 1 : 0;
  }
  require_gap_fits(scan);
  necklace_.emplace(beads_.chains, radii);
  report_.map = necklace::ContactMap(*necklace_, options_.query, options_.bins);
  report_.probability = necklace::ContactProbability(*necklace_, options_.query);
  for (std::size_t chain = 0; chain <= beads_.chains.size(); ++chain) {
    report_.chain_ends.push_back(necklace_->first_place(chain));
  }
}

/// Refuses a gap for which two images of a bead might touch another, before any work is done.
void ContactAnalysis::require_gap_fits(const Scan& scan) const {
  const double reach = 2 * report_.largest_radius + options_.query.gap;
  const double limit = 0.5 * scan.smallest_height;
  if (reach <= limit) return;
  throw UsageError(fmt::format(
      "{}: frame {}: twice the largest radius + gap = {} exceeds half the smallest box height, {} "
      "({}); give radii and a gap that sum up to at most that, or leave the frame out with "
      "--frames",
      scan.file, scan.smallest_height_frame, reach, limit, scan.unit));
}

void ContactAnalysis::open_data_file() {
  if (options_.data.empty()) return;
  ContactFileHeader header;
  header.source = options_.input.name();
  header.topology = beads_.source;
  header.unit = report_.unit;
  header.time = report_.has_times ? "time" : "step";
  header.query = options_.query;
  data_.emplace(options_.data, header, *necklace_, beads_.ids);
}

/// Starts the threads, so it comes after the child processes: a process that forks while its threads run
/// hands the child whatever locks they hold, and nobody there gives them back.
void ContactAnalysis::start_search() {
  threads_ = make_threads(options_.threads);
  necklace::ContactFinderParams params;
  params.executor = threads_.get();
  params.refuse_undetermined = true;  // such a bond is one of other chains than the trajectory's
  contacts_.emplace(*std::move(necklace_), params);
  necklace_.reset();
  report_.cages = static_cast<std::int64_t>(contacts_->wrapped().trees().nodes().size());
}

void ContactAnalysis::follow_frames() {
  FrameStream stream(options_.input, options_.frames);
  start_search();
  progress_.start("following contacts", frames_expected_);
  trajectory::Frame frame;
  for (std::int64_t done = 0; done < frames_expected_; ++done) {
    const Stopwatch watch;
    if (!stream.next(frame)) fail_changed(options_.input.name());
    follow_frame(frame, stream.index(), watch.milliseconds());
    progress_.advance(done + 1);
  }
  progress_.clear();
}

void ContactAnalysis::follow_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms) {
  ContactFrame record;
  record.frame = index;
  record.step = frame.step;
  record.time = frame.time;
  record.read_ms = read_ms;
  const double time = time_of(frame, index);
  const std::vector<necklace::Contact> contacts = contacts_of(frame, index, record);
  const Stopwatch follow;
  for (const necklace::Contact& contact : contacts) {
    const bool within = beads_.chains.chain_of(contact.i) == beads_.chains.chain_of(contact.j);
    ++(within ? record.within : record.between);
  }
  report_.map.add(contacts);
  report_.probability.add(contacts);
  const auto ended = events_.add(time, contacts);
  report_.events.add(ended);
  record.follow_ms = follow.milliseconds();
  if (data_) {
    const Stopwatch watch;
    data_->append(record);
    data_->append(ended);
    report_.write_ms += watch.milliseconds();
  }
  report_.frames.push_back(record);
}

/// The time of events: the frame's, or its time step where some frame has no time.
double ContactAnalysis::time_of(const trajectory::Frame& frame, std::int64_t index) {
  if (report_.has_times && !frame.time) fail_changed(options_.input.name());
  const double time = report_.has_times ? *frame.time : static_cast<double>(frame.step);
  const char* const what = report_.has_times ? "time" : "time step";
  if (!std::isfinite(time)) {
    throw trajectory::FileError(fmt::format("{}: frame {}: its time is {}; contacts need finite times",
                                            options_.input.name(), index, time));
  }
  if (!report_.frames.empty() && time < last_time_) {
    throw UsageError(
        fmt::format("{}: frame {}: its {}, {}, is before that of the frame before, {}; contacts are followed "
                    "forwards, so select frames in order of time with --frames",
                    options_.input.name(), index, what, time, last_time_));
  }
  last_time_ = time;
  return time;
}

std::vector<necklace::Contact> ContactAnalysis::contacts_of(const trajectory::Frame& frame,
                                                            std::int64_t index, ContactFrame& record) {
  const std::vector<Vec3>& positions = finder_->positions(frame, index);
  const auto place = [&](const std::string& what) {
    return fmt::format("{}: frame {}: {}", options_.input.name(), index, what);
  };
  try {
    const Stopwatch update;
    contacts_->update(positions, frame.box);
    contacts_->prepare(options_.query);
    record.update_ms = update.milliseconds();
    const Stopwatch search;
    auto contacts = contacts_->find_contacts(options_.query);
    record.search_ms = search.milliseconds();
    record.by = contacts_->answered_by();
    return contacts;
  } catch (const necklace::Undetermined& error) {
    throw trajectory::FileError(place(bond_text(error, frame.box)));
  } catch (const InvalidPosition& error) {
    throw trajectory::FileError(place(error.what()));
  } catch (const InvalidBox& error) {
    throw trajectory::FileError(place(error.what()));
  } catch (const Error& error) {
    throw UsageError(place(error.what()));
  }
}

/// The error with ids in place of the beads' numbers.
std::string ContactAnalysis::bond_text(const necklace::Undetermined& error, const Box& box) const {
  const auto [a, b] = error.bond();
  const auto first = static_cast<std::size_t>(a), second = static_cast<std::size_t>(b);
  const std::vector<Vec3>& positions = finder_->last_positions();
  const double length = std::sqrt(box.distance2(positions[first], positions[second]));
  if (length < box.max_cutoff()) {
    return fmt::format(
        "the ring closed by the bond of the atoms with the ids {} and {} winds around the "
        "periodic box, so it has no closed image; check the chains of {}",
        beads_.ids[first], beads_.ids[second], beads_.source);
  }
  return fmt::format(
      "the bond of the atoms with the ids {} and {} is {} long, not below half the smallest box "
      "height, {}, so that which image it leads to cannot be told; check the chains of {}, or name those "
      "that "
      "are chains with --molecules and other bonds with --topology",
      beads_.ids[first], beads_.ids[second], length, box.max_cutoff(), beads_.source);
}

void ContactAnalysis::finish() {
  const std::vector<necklace::ContactEvent> running = events_.finish();
  report_.events.add(running);
  report_.structure = contacts_->wrapped().stats();
  report_.choice = contacts_->choice();
  if (!data_) return;
  const Stopwatch watch;
  data_->append(running);
  data_->finish(report_.map, report_.probability);
  report_.write_ms += watch.milliseconds();
}

}  // namespace

ContactReport analyze_contacts(const ContactOptions& options, ProgressBar& progress) {
  return ContactAnalysis(options, progress).run();
}

}  // namespace dch::cli

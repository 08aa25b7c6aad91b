// SPDX-License-Identifier: MIT
#include "analysis/replay.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

#include <dch/engines/verlet_list.hpp>
#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/topology.hpp>

#include "analysis/between_frames.hpp"
#include "analysis/frame_errors.hpp"
#include "analysis/replay_view.hpp"
#include "base/exit_code.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "engines/list_statistics.hpp"
#include "input/frame_stream.hpp"
#include "report/list_file.hpp"

namespace dch::cli {
namespace {

std::string exclusion_rule(int depth) { return depth == 0 ? "" : fmt::format("1-{}", depth + 1); }

/// Refuses a list radius that some selected frame's box is too small for, before any work is done.
void require_cutoff_fits(const ReplayOptions& options, const Scan& scan) {
  const double radius = options.cutoff + options.skin;
  const double limit = 0.5 * scan.smallest_height;
  if (radius <= limit) return;
  throw UsageError(
      fmt::format("{}: frame {}: cutoff + skin = {} exceeds half the smallest box height, {} ({}); give a "
                  "cutoff and a skin that "
                  "sum up to at most {}, or leave the frame out with --frames",
                  scan.file, scan.smallest_height_frame, radius, limit, scan.unit, limit));
}

/// Between frames there is nothing to be seen of fewer than two.
void require_two_frames(const ReplayOptions& options, const Scan& scan) {
  if (!options.continuous || scan.frames > 1) return;
  throw UsageError(fmt::format(
      "{}: --continuous looks at what is between frames, and 1 frame of {} is selected; select two or more "
      "with --frames, or leave out --continuous",
      scan.file, scan.frames_passed));
}

/// One run: what is found out beforehand, and the state that goes through the frames.
class Replay {
 public:
  Replay(const ReplayOptions& options, ProgressBar& progress);
  ReplayReport run();

 private:
  void scan();
  void take_atoms(const trajectory::Frame& frame);
  void start_engine();
  void start_list();
  void read_exclusions(const trajectory::Frame& frame);
  void open_list_file(std::int64_t most_atoms);
  void replay_frames();
  void replay_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms);
  void digest_list(const trajectory::Frame& frame, const FrameRecord& record);
  void follow(const trajectory::Frame& frame, std::int64_t index);
  void note_engine();

  const ReplayOptions& options_;
  ProgressBar& progress_;
  Stopwatch watch_;
  ReplayReport report_;
  std::int64_t frames_expected_ = 0;
  bool atoms_change_ = false;
  Engine engine_;  // before the list that borrows it
  Exclusions exclusions_;
  ListParams params_;
  std::vector<std::int64_t> ids_;  ///< of the atoms that list_ is for
  std::optional<VerletList> list_;
  std::optional<Verifier> verifier_;
  std::optional<ListFile> list_file_;
  std::optional<BetweenFrames> between_;
  std::optional<ReplayView> view_;
  ListStatistics statistics_;
};

Replay::Replay(const ReplayOptions& options, ProgressBar& progress) : options_(options), progress_(progress) {
  params_.cutoffs = TypeCutoffs(options.cutoff);
  params_.skin = options.skin;
  params_.kind = options.kind;
  report_.cutoff = options.cutoff;
  report_.skin = options.skin;
  report_.list_kind = options.kind;
  report_.engine = options.engine;
}

ReplayReport Replay::run() {
  scan();
  verifier_.emplace(options_.verify, params_, frames_expected_);
  replay_frames();
  note_engine();
  if (list_file_) list_file_->commit();
  view_->commit();
  report_.degree_histogram = statistics_.degree_histogram();
  report_.list_hash = statistics_.hash();
  report_.verify = verifier_->result();
  report_.total_ms = watch_.milliseconds();
  return std::move(report_);
}

void Replay::scan() {
  const Stopwatch watch;
  const Scan scan = scan_trajectory(options_.input, options_.frames, progress_);
  report_.scan_ms = watch.milliseconds();
  static_cast<TrajectorySummary&>(report_) = scan;
  frames_expected_ = scan.frames;
  atoms_change_ = scan.atoms_change;
  require_cutoff_fits(options_, scan);
  require_two_frames(options_, scan);
  take_atoms(scan.first_frame);
  open_list_file(scan.most_atoms);
  view_.emplace(options_, scan);
}

void Replay::take_atoms(const trajectory::Frame& frame) {
  ids_ = frame.ids;
  read_exclusions(frame);
}

/// Starts the threads, so it comes after the child processes: a process that forks while its threads run
/// hands the child whatever locks they hold, and nobody there gives them back.
void Replay::start_engine() {
  engine_ = make_engine(options_.engine, options_.cutoff + options_.skin,
                        options_.threads > 1 ? make_threads(options_.threads) : nullptr);
  if (engine_.threads) report_.threads = engine_.threads->threads();
  view_->start(engine_.threads.get());
  if (!options_.continuous) return;
  const EngineKind kind = options_.engine.kind;
  between_.emplace(options_.cutoff, to_string(kind == EngineKind::allpairs ? EngineKind::cell : kind),
                   engine_.threads.get());
  report_.between.emplace();
}

/// Starts a list for the atoms taken. The engine stays; where atoms come and go, it is told who they are.
void Replay::start_list() {
  std::vector<std::uint64_t> keys;
  if (atoms_change_) keys.assign(ids_.begin(), ids_.end());
  // By half the skin, which all engines tell alike: their lists of a frame can be compared.
  list_.emplace(borrow(*engine_.search, std::move(keys)), params_, Expiry::half_skin);
}

void Replay::read_exclusions(const trajectory::Frame& frame) {
  if (options_.topology.empty() && options_.exclude_depth == 0) return;
  if (options_.topology.empty() && frame.molecules.empty()) {
    throw UsageError(
        fmt::format("--exclude {} needs bonds, but {} has no molecule column; give them with --topology",
                    exclusion_rule(options_.exclude_depth), options_.input.name()));
  }
  const trajectory::Topology topology =
      options_.topology.empty()
          ? trajectory::topology_from_molecules(frame, options_.input.name())
          : trajectory::read_topology(options_.topology, frame.ids, options_.input.limits());
  ExclusionRecord record;
  record.source = topology.source;
  record.bonds = static_cast<std::int64_t>(topology.bonds.size());
  if (options_.exclude_depth > 0) {
    exclusions_ = Exclusions::from_bonds(frame.positions.size(), topology.bonds, options_.exclude_depth);
    params_.exclusions = &exclusions_;
    record.rule = exclusion_rule(options_.exclude_depth);
    record.pairs = exclusions_.pairs();
  }
  if (report_.frames.empty()) report_.exclusions = record;
}

void Replay::open_list_file(std::int64_t most_atoms) {
  if (options_.lists.empty()) return;
  ListFileHeader header;
  header.source = options_.input.name();
  header.unit = report_.unit;
  header.engine = to_string(options_.engine.kind);
  header.exclusions = options_.exclude_depth == 0 ? "none" : exclusion_rule(options_.exclude_depth);
  header.cutoff = options_.cutoff;
  header.skin = options_.skin;
  header.kind = options_.kind;
  header.continuous = options_.continuous;
  header.most_atoms = static_cast<std::size_t>(most_atoms);
  list_file_.emplace(options_.lists, header);
}

void Replay::replay_frames() {
  FrameStream stream(options_.input, options_.frames);
  start_engine();
  start_list();
  progress_.start("replaying", frames_expected_);
  trajectory::Frame frame;
  for (std::int64_t done = 0; done < frames_expected_; ++done) {
    const Stopwatch watch;
    if (!stream.next(frame)) fail_changed(options_.input.name());
    const double read_ms = watch.milliseconds();
    if (static_cast<std::int64_t>(frame.ids.size()) > report_.most_atoms) fail_changed(options_.input.name());
    if (frame.ids != ids_) {
      if (!atoms_change_) fail_changed(options_.input.name());
      take_atoms(frame);
      start_list();
    }
    replay_frame(frame, stream.index(), read_ms);
    if (between_) follow(frame, stream.index());
    view_->append(frame, stream.index(), params_);
    progress_.advance(done + 1);
  }
  progress_.clear();
}

void Replay::replay_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms) {
  FrameRecord record;
  record.frame = index;
  record.step = frame.step;
  record.time = frame.time;
  record.atoms = static_cast<std::int64_t>(frame.ids.size());
  record.read_ms = read_ms;
  const SearchStats before = engine_.search->stats();
  const Stopwatch watch;
  record.list_rebuilt =
      in_frame(options_.input.name(), index, [&] { return list_->update(frame.positions, frame.box); });
  const double update_ms = watch.milliseconds();
  const SearchStats& after = engine_.search->stats();
  record.list_ms = 1e3 * (after.list_seconds - before.list_seconds);
  record.maintain_ms =
      std::max(0.0, update_ms - record.list_ms);  // the structure's upkeep and the stale test
  record.refreshes = after.refreshes - before.refreshes;
  record.repairs = after.repairs - before.repairs;
  record.rebuilds = after.builds - before.builds;
  record.promotions = after.promotions - before.promotions;
  record.demotions = after.demotions - before.demotions;
  record.levels = after.levels;
  record.pairs = list_->list().pairs();
  digest_list(frame, record);
  report_.frames.push_back(record);
}

/// From the frame before to this one.
void Replay::follow(const trajectory::Frame& frame, std::int64_t index) {
  if (!in_frame(options_.input.name(), index, [&] { return between_->follow(frame, index, exclusions_); }))
    return;
  report_.between->add(between_->record(), between_->contacts(), options_.cutoff);
  if (list_file_) {
    const Stopwatch watch;
    list_file_->append(between_->record(), between_->contacts());
    report_.write_ms += watch.milliseconds();
  }
  if (!between_->record().undetermined.empty()) return;
  const Stopwatch watch;
  Verifier::Interval interval = between_->subject();
  interval.ordinal = static_cast<std::int64_t>(report_.between->intervals.size()) - 1;
  verifier_->check_between(interval);
  report_.verify_ms += watch.milliseconds();
}

void Replay::digest_list(const trajectory::Frame& frame, const FrameRecord& record) {
  const NeighborList& list = list_->list();
  statistics_.add(list, record.list_rebuilt);
  if (list_file_) {
    const Stopwatch watch;
    list_file_->append(record.frame, frame, list, record.list_rebuilt);
    report_.write_ms += watch.milliseconds();
  }
  Verifier::Subject subject;
  subject.ordinal = static_cast<std::int64_t>(report_.frames.size());
  subject.index = record.frame;
  subject.frame = &frame;
  subject.list = &list;
  subject.list_is_new = record.list_rebuilt;
  subject.structure = engine_.keeps_hierarchy ? engine_.search.get() : nullptr;
  const Stopwatch watch;
  verifier_->check(subject);
  report_.verify_ms += watch.milliseconds();
}

void Replay::note_engine() {
  report_.levels = engine_.search->levels();
  report_.choice = engine_.search->choice();
}

}  // namespace

ReplayReport run_replay(const ReplayOptions& options, ProgressBar& progress) {
  return Replay(options, progress).run();
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "replay.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <utility>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/topology.hpp>
#include <dch/verlet_list.hpp>

#include "exit_code.hpp"
#include "frame_stream.hpp"
#include "list_file.hpp"
#include "list_statistics.hpp"
#include "stopwatch.hpp"

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
                  scan.path, scan.smallest_height_frame, radius, limit, scan.length_unit, limit));
}

/// The file changed on disk between the two passes.
[[noreturn]] void fail_changed(const std::string& path) {
  throw trajectory::FileError(fmt::format(
      "{}: changed while it was read; wait until it is complete, or select the frames there with --frames",
      path));
}

/// One run: what is found out beforehand, and the state that goes through the frames.
class Replay {
 public:
  Replay(const ReplayOptions& options, ProgressBar& progress);
  ReplayReport run();

 private:
  void scan();
  void read_topology(const trajectory::Frame& first);
  void open_list_file(const trajectory::Frame& first);
  void replay_frames();
  void replay_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms);
  bool update_list(const trajectory::Frame& frame, std::int64_t index);
  void digest_list(const trajectory::Frame& frame, const FrameRecord& record);
  void note_levels();

  const ReplayOptions& options_;
  ProgressBar& progress_;
  Stopwatch watch_;
  ReplayReport report_;
  std::int64_t frames_expected_ = 0;
  Exclusions exclusions_;  // before the list that refers to it
  ListParams params_;
  const Hierarchy* hierarchy_ = nullptr;
  std::optional<VerletList> list_;
  std::optional<Verifier> verifier_;
  std::optional<ListFile> list_file_;
  ListStatistics statistics_;
};

Replay::Replay(const ReplayOptions& options, ProgressBar& progress) : options_(options), progress_(progress) {
  params_.cutoffs = TypeCutoffs(options.cutoff);
  params_.skin = options.skin;
  params_.kind = options.kind;
  report_.file = options.file;
  report_.cutoff = options.cutoff;
  report_.skin = options.skin;
  report_.list_kind = options.kind;
  report_.engine = options.engine;
}

ReplayReport Replay::run() {
  scan();
  verifier_.emplace(options_.verify, params_, frames_expected_);
  Engine engine = make_engine(options_.engine, options_.cutoff + options_.skin);
  hierarchy_ = engine.hierarchy;
  list_.emplace(std::move(engine.search), params_);
  replay_frames();
  note_levels();
  if (list_file_) list_file_->commit();
  report_.degree_histogram = statistics_.degree_histogram();
  report_.list_hash = statistics_.hash();
  report_.verify = verifier_->result();
  report_.total_ms = watch_.milliseconds();
  return std::move(report_);
}

void Replay::scan() {
  const Stopwatch watch;
  const Scan scan = scan_trajectory(options_.file, options_.frames, progress_);
  report_.scan_ms = watch.milliseconds();
  report_.format = scan.format;
  report_.unit = scan.length_unit;
  report_.frames_passed = scan.frames_passed;
  report_.atoms = static_cast<std::int64_t>(scan.atoms());
  report_.box_kinds = scan.box_kinds;
  report_.smallest_height = scan.smallest_height;
  report_.smallest_height_frame = scan.smallest_height_frame;
  frames_expected_ = scan.frames;
  require_cutoff_fits(options_, scan);
  read_topology(scan.first_frame);
  open_list_file(scan.first_frame);
}

void Replay::read_topology(const trajectory::Frame& first) {
  if (options_.topology.empty() && options_.exclude_depth == 0) return;
  if (options_.topology.empty() && first.molecules.empty()) {
    throw UsageError(
        fmt::format("--exclude {} needs bonds, but {} has no molecule column; give them with --topology",
                    exclusion_rule(options_.exclude_depth), options_.file));
  }
  const trajectory::Topology topology = options_.topology.empty()
                                            ? trajectory::topology_from_molecules(first, options_.file)
                                            : trajectory::read_topology(options_.topology, first.ids);
  report_.exclusions.source = topology.source;
  report_.exclusions.bonds = static_cast<std::int64_t>(topology.bonds.size());
  if (options_.exclude_depth == 0) return;
  exclusions_ = Exclusions::from_bonds(first.positions.size(), topology.bonds, options_.exclude_depth);
  params_.exclusions = &exclusions_;
  report_.exclusions.rule = exclusion_rule(options_.exclude_depth);
  report_.exclusions.pairs = exclusions_.pairs();
}

void Replay::open_list_file(const trajectory::Frame& first) {
  if (options_.lists.empty()) return;
  ListFileHeader header;
  header.source = options_.file;
  header.unit = report_.unit;
  header.engine = to_string(options_.engine.kind);
  header.exclusions = options_.exclude_depth == 0 ? "none" : exclusion_rule(options_.exclude_depth);
  header.cutoff = options_.cutoff;
  header.skin = options_.skin;
  header.kind = options_.kind;
  header.ids = first.ids;
  list_file_.emplace(options_.lists, header);
}

void Replay::replay_frames() {
  FrameStream stream(options_.file, options_.frames);
  progress_.start("replaying", frames_expected_);
  trajectory::Frame frame;
  for (std::int64_t done = 0; done < frames_expected_; ++done) {
    const Stopwatch watch;
    if (!stream.next(frame)) fail_changed(options_.file);
    const double read_ms = watch.milliseconds();
    if (static_cast<std::int64_t>(frame.positions.size()) != report_.atoms) fail_changed(options_.file);
    replay_frame(frame, stream.index(), read_ms);
    progress_.advance(done + 1);
  }
  progress_.clear();
}

void Replay::replay_frame(const trajectory::Frame& frame, std::int64_t index, double read_ms) {
  FrameRecord record;
  record.frame = index;
  record.step = frame.step;
  record.time = frame.time;
  record.read_ms = read_ms;
  const SearchStats before = list_->search().stats();
  const Stopwatch watch;
  record.list_rebuilt = update_list(frame, index);
  const double update_ms = watch.milliseconds();
  const SearchStats& after = list_->search().stats();
  record.list_ms = 1e3 * (after.list_seconds - before.list_seconds);
  record.maintain_ms =
      std::max(0.0, update_ms - record.list_ms);  // the structure's upkeep and the stale test
  record.repairs = after.repairs - before.repairs;
  record.rebuilds = after.builds - before.builds;
  record.promotions = after.promotions - before.promotions;
  record.demotions = after.demotions - before.demotions;
  record.levels = after.levels;
  record.pairs = list_->list().pairs();
  digest_list(frame, record);
  report_.frames.push_back(record);
}

bool Replay::update_list(const trajectory::Frame& frame, std::int64_t index) {
  const auto place = [&](const Error& error) {
    return fmt::format("{}: frame {}: {}", options_.file, index, error.what());
  };
  try {
    return list_->update(frame.positions, frame.box);
  } catch (const InvalidPosition& error) {
    throw trajectory::FileError(place(error));
  } catch (const InvalidBox& error) {
    throw trajectory::FileError(place(error));
  } catch (const Error& error) {
    throw UsageError(place(error));
  }
}

void Replay::digest_list(const trajectory::Frame& frame, const FrameRecord& record) {
  const NeighborList& list = list_->list();
  statistics_.add(list, record.list_rebuilt);
  if (list_file_) {
    const Stopwatch watch;
    list_file_->append(record.frame, record.step, list, record.list_rebuilt);
    report_.write_ms += watch.milliseconds();
  }
  Verifier::Subject subject;
  subject.ordinal = static_cast<std::int64_t>(report_.frames.size());
  subject.index = record.frame;
  subject.frame = &frame;
  subject.list = &list;
  subject.list_is_new = record.list_rebuilt;
  subject.hierarchy = hierarchy_;
  const Stopwatch watch;
  verifier_->check(subject);
  report_.verify_ms += watch.milliseconds();
}

void Replay::note_levels() {
  if (!hierarchy_) return;
  for (int level = 0; level < hierarchy_->levels(); ++level)
    report_.levels.push_back(hierarchy_->level(level));
}

}  // namespace

ReplayReport run_replay(const ReplayOptions& options, ProgressBar& progress) {
  return Replay(options, progress).run();
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "input/frame_stream.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include <dch/trajectory/file_error.hpp>

#include "base/exit_code.hpp"

namespace dch::cli {
namespace {

void note_box(const Box& box, std::int64_t index, Scan& scan) {
  const std::string kind = box.description();
  if (std::find(scan.box_kinds.begin(), scan.box_kinds.end(), kind) == scan.box_kinds.end()) {
    scan.box_kinds.push_back(kind);
  }
  if (box.min_height() >= scan.smallest_height) return;
  scan.smallest_height = box.min_height();
  scan.smallest_height_frame = index;
}

void note_frame(const trajectory::Frame& frame, std::int64_t index, Scan& scan) {
  const auto atoms = static_cast<std::int64_t>(frame.ids.size());
  if (scan.frames == 0) {
    scan.first_frame = frame;
    scan.fewest_atoms = scan.most_atoms = atoms;
    scan.smallest_height_frame = index;
  }
  note_box(frame.box, index, scan);
  scan.fewest_atoms = std::min(scan.fewest_atoms, atoms);
  scan.most_atoms = std::max(scan.most_atoms, atoms);
  scan.last_step = frame.step;
  scan.last_time = frame.time;
  scan.has_times = scan.has_times && frame.time.has_value();
  ++scan.frames;
}

void require_frames(const Scan& scan, const FrameRange& range) {
  if (scan.frames > 0) return;
  if (scan.frames_passed == 0) {
    throw trajectory::FileError(
        fmt::format("{}: holds no frame; a trajectory needs at least one", scan.file));
  }
  throw UsageError(
      fmt::format("--frames selects no frame of {}: it starts at frame {}, and the file's frames are 0 to "
                  "{}; give a smaller first frame",
                  scan.file, range.begin, scan.frames_passed - 1));
}

}  // namespace

FrameStream::FrameStream(const TrajectoryInput& input, const FrameRange& range)
    : range_(range), reader_(input.open()) {}

bool FrameStream::next(trajectory::Frame& frame) {
  while (passed_ < range_.end) {
    if (!reader_->read(frame)) return false;
    ++passed_;
    if (range_.contains(passed_ - 1)) return true;
  }
  return false;
}

Scan scan_trajectory(const TrajectoryInput& input, const FrameRange& range, ProgressBar& progress) {
  FrameStream stream(input, range);
  Scan scan;
  scan.file = input.name();
  scan.format = stream.reader().format();
  scan.smallest_height = std::numeric_limits<double>::infinity();
  progress.start("checking " + input.name());
  trajectory::Frame frame;
  std::vector<std::int64_t> ids;
  while (stream.next(frame)) {
    note_frame(frame, stream.index(), scan);
    scan.atoms_change = scan.atoms_change || (scan.frames > 1 && frame.ids != ids);
    ids = frame.ids;
    progress.advance(stream.index());
  }
  scan.frames_passed = stream.passed();
  scan.unit = stream.reader().length_unit();
  progress.clear();
  require_frames(scan, range);
  return scan;
}

void fail_changed(const std::string& path) {
  throw trajectory::FileError(fmt::format(
      "{}: changed while it was read; wait until it is complete, or select the frames there with --frames",
      path));
}

}  // namespace dch::cli

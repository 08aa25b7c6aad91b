// SPDX-License-Identifier: MIT
#include "gromacs_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "cell.hpp"
#include "forked_reader.hpp"
#include "place.hpp"

namespace dch::trajectory {
namespace {

using MakeScanner = std::unique_ptr<FrameScanner> (*)(const std::string& path);

std::unique_ptr<TrajectoryReader> make_reader(const std::string& path, const std::string& format,
                                              MakeScanner make_scanner) {
  make_scanner(path);  // refuses files that cannot be opened before a process is started for them
  return std::make_unique<ForkedReader>(
      path, [=] { return std::make_unique<GromacsReader>(path, format, make_scanner(path)); });
}

}  // namespace

GromacsReader::GromacsReader(const std::string& path, std::string format,
                             std::unique_ptr<FrameScanner> scanner)
    : path_(path), format_(std::move(format)), scanner_(std::move(scanner)), file_(path) {}

bool GromacsReader::read(Frame& frame) {
  FrameSummary summary;
  if (!find_frame(summary)) {
    if (frames_ == 0) fail(path_, "the file holds no frame with positions");
    return false;
  }
  frame.step = frames_;
  try {
    if (!file_.read(frame))
      fail_here(summary, "libgromacs finds no frame with positions here: the file is broken");
  } catch (const InvalidBox& error) {
    fail_here(summary, error.what());
  }
  check(frame, summary);
  frame.ids.resize(frame.positions.size());
  std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
  ++frames_;
  return true;
}

bool GromacsReader::find_frame(FrameSummary& summary) {
  while (scanner_->next(summary)) {
    ++scanned_;
    if (atoms_ == 0) atoms_ = summary.atoms;
    if (summary.atoms != atoms_) {
      fail_here(summary, fmt::format("the frame has {} atoms, the first frame {}", summary.atoms, atoms_));
    }
    if (summary.has_positions) return true;
  }
  return false;
}

void GromacsReader::check(const Frame& frame, const FrameSummary& summary) const {
  if (static_cast<std::int64_t>(frame.positions.size()) != summary.atoms) {
    fail_here(summary, fmt::format("the frame has {} atoms, but libgromacs reads {}", summary.atoms,
                                   frame.positions.size()));
  }
  const auto bad = std::find_if_not(frame.positions.begin(), frame.positions.end(), is_valid_position);
  if (bad != frame.positions.end()) {
    fail_here(summary, fmt::format("atom {} has a coordinate that is not finite: {} {} {}",
                                   bad - frame.positions.begin() + 1, bad->x, bad->y, bad->z));
  }
}

void GromacsReader::fail_here(const FrameSummary& summary, const std::string& what) const {
  fail(path_, fmt::format("frame {}, {}: {}", scanned_ - 1, summary.place, what));
}

std::unique_ptr<TrajectoryReader> make_xtc_reader(const std::string& path) {
  return make_reader(path, "GROMACS XTC", make_xtc_scanner);
}

std::unique_ptr<TrajectoryReader> make_trr_reader(const std::string& path) {
  return make_reader(path, "GROMACS TRR", make_trr_scanner);
}

std::unique_ptr<TrajectoryReader> make_gro_reader(const std::string& path) {
  return make_reader(path, "GROMACS GRO", make_gro_scanner);
}

}  // namespace dch::trajectory

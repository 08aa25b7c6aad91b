// SPDX-License-Identifier: MIT
#include "gromacs/gromacs_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "base/place.hpp"
#include "frames/cell.hpp"
#include "gromacs/trr_decoder.hpp"
#include "gromacs/xtc_decoder.hpp"

namespace dch::trajectory {

GromacsReader::GromacsReader(const std::string& path, std::string format,
                             std::unique_ptr<FrameDecoder> decoder)
    : file_(path), format_(std::move(format)), decoder_(std::move(decoder)) {}

bool GromacsReader::read(Frame& frame) {
  FrameExtent extent;
  if (!find_frame(extent)) {
    if (frames_ == 0) fail(file_.path(), "the file holds no frame with positions");
    return false;
  }
  decode(extent, frame);
  const auto bad = std::find_if_not(frame.positions.begin(), frame.positions.end(), is_valid_position);
  if (bad != frame.positions.end()) {
    fail_here(0, fmt::format("atom {} has a coordinate that is not finite: {} {} {}",
                             bad - frame.positions.begin() + 1, bad->x, bad->y, bad->z));
  }
  frame.ids.resize(frame.positions.size());
  std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
  frame.types.clear();
  frame.molecules.clear();
  frame.images.clear();
  ++frames_;
  return true;
}

bool GromacsReader::find_frame(FrameExtent& extent) {
  while (next_ < file_.size()) {
    offset_ = next_;
    ++found_;
    extent = measure();
    check(extent);
    next_ = offset_ + extent.total;
    if (extent.has_positions) return true;
  }
  return false;
}

FrameExtent GromacsReader::measure() try {
  bytes_.resize(FrameDecoder::kLongestHeader);
  const std::size_t got = file_.read_at(offset_, bytes_.data(), bytes_.size());
  return decoder_->measure(Bytes(bytes_).first(got));
} catch (const BrokenFrame& error) {
  fail_here(error.offset(), error.what());
}

void GromacsReader::check(const FrameExtent& extent) const {
  if (atoms_ != 0 && extent.atoms != atoms_) {
    fail_here(0, fmt::format("the frame has {} atoms, the first frame {}", extent.atoms, atoms_));
  }
  if (extent.total > file_.size() - offset_) {
    fail_here(0, fmt::format("a frame of {} bytes begins here, but the file ends at byte {}: it is truncated",
                             extent.total, file_.size()));
  }
}

void GromacsReader::decode(const FrameExtent& extent, Frame& frame) try {
  if (atoms_ == 0) atoms_ = extent.atoms;
  bytes_.resize(static_cast<std::size_t>(extent.needed));
  if (file_.read_at(offset_, bytes_.data(), bytes_.size()) != bytes_.size()) {
    fail_here(0, "the file was cut while it was read");
  }
  decoder_->decode(bytes_, frame);
} catch (const BrokenFrame& error) {
  fail_here(error.offset(), error.what());
} catch (const InvalidBox& error) {
  fail_here(0, error.what());
}

void GromacsReader::fail_here(std::int64_t offset, const std::string& what) const {
  fail_at_byte(file_.path(), found_ - 1, offset_ + offset, what);
}

std::unique_ptr<TrajectoryReader> make_xtc_reader(const std::string& path) {
  return std::make_unique<GromacsReader>(path, "GROMACS XTC", std::make_unique<XtcDecoder>());
}

std::unique_ptr<TrajectoryReader> make_trr_reader(const std::string& path) {
  return std::make_unique<GromacsReader>(path, "GROMACS TRR", std::make_unique<TrrDecoder>());
}

}  // namespace dch::trajectory

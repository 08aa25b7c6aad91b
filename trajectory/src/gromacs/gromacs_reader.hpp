// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "files/input_file.hpp"
#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

/// XTC and TRR: brings the bytes of one frame after the other to a decoder.
///
/// A frame's bytes are read when the file is known to hold all of them, so memory is at most a fixed multiple
/// of the size of the file. Frames of a TRR file without positions are passed over, as GROMACS's own tools
/// do.
class GromacsReader final : public TrajectoryReader {
 public:
  /// @throws FileError as InputFile.
  GromacsReader(const std::string& path, std::string format, std::unique_ptr<FrameDecoder> decoder);

  bool read(Frame& frame) override;
  std::string format() const override { return format_; }
  std::string length_unit() const override { return "nm"; }

 private:
  bool find_frame(FrameExtent& extent);
  FrameExtent measure();
  void decode(const FrameExtent& extent, Frame& frame);
  void check(const FrameExtent& extent) const;
  [[noreturn]] void fail_here(std::int64_t offset, const std::string& what) const;

  InputFile file_;
  std::string format_;
  std::unique_ptr<FrameDecoder> decoder_;
  std::vector<unsigned char> bytes_;
  std::int64_t offset_ = 0;  ///< in the file, of the frame at hand
  std::int64_t next_ = 0;    ///< of the one behind it
  std::int64_t found_ = 0;   ///< frames, with and without positions
  std::int64_t frames_ = 0;  ///< frames with positions
  std::int64_t atoms_ = 0;
};

/// @throws FileError as open_trajectory.
std::unique_ptr<TrajectoryReader> make_xtc_reader(const std::string& path);
std::unique_ptr<TrajectoryReader> make_trr_reader(const std::string& path);

}  // namespace dch::trajectory

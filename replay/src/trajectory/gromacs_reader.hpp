// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <dch/trajectory/reader.hpp>

#include "frame_scanner.hpp"
#include "gromacs_file.hpp"

namespace dch::trajectory {

/// XTC, TRR and GRO: libgromacs reads each frame after the scanner has found it whole. Use it in a child
/// process only (make_gromacs_reader does): libgromacs may end the process.
///
/// Frames of a TRR file without positions are passed over, as GROMACS's own tools do.
class GromacsReader final : public TrajectoryReader {
 public:
  GromacsReader(const std::string& path, std::string format, std::unique_ptr<FrameScanner> scanner);

  bool read(Frame& frame) override;
  std::string format() const override { return format_; }
  std::string length_unit() const override { return "nm"; }

 private:
  bool find_frame(FrameSummary& summary);
  void check(const Frame& frame, const FrameSummary& summary) const;
  [[noreturn]] void fail_here(const FrameSummary& summary, const std::string& what) const;

  std::string path_;
  std::string format_;
  std::unique_ptr<FrameScanner> scanner_;
  GromacsFile file_;
  std::int64_t scanned_ = 0;  ///< frames the scanner has found, with and without positions
  std::int64_t frames_ = 0;   ///< frames with positions
  std::int64_t atoms_ = 0;
};

/// A reader for .xtc, .trr or .gro in a child process.
/// @throws FileError as open_trajectory.
std::unique_ptr<TrajectoryReader> make_xtc_reader(const std::string& path);
std::unique_ptr<TrajectoryReader> make_trr_reader(const std::string& path);
std::unique_ptr<TrajectoryReader> make_gro_reader(const std::string& path);

}  // namespace dch::trajectory

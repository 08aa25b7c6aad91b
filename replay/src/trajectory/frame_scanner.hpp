// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace dch::trajectory {

/// What a scanner finds out about a frame without unpacking it.
struct FrameSummary {
  std::string place;  ///< where the frame begins, for messages: "byte 1234", "line 12"
  std::int64_t atoms = 0;
  bool has_positions = true;
};

/// Walks over the frames of a file and checks that each is whole and soundly built, without reading all of
/// it.
///
/// libgromacs takes a truncated file for a normal end; the scanner knows better.
class FrameScanner {
 public:
  virtual ~FrameScanner() = default;
  /// The next frame; false at the end of the file. @throws FileError.
  virtual bool next(FrameSummary& summary) = 0;
};

/// @throws FileError as InputFile.
std::unique_ptr<FrameScanner> make_xtc_scanner(const std::string& path);
std::unique_ptr<FrameScanner> make_trr_scanner(const std::string& path);
std::unique_ptr<FrameScanner> make_gro_scanner(const std::string& path);

}  // namespace dch::trajectory

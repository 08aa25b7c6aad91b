// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engines/viewed_hierarchy.hpp"
#include "report/output_file.hpp"

namespace dch::cli {

/// What a page that shows frames says about all of them.
struct ViewHeader {
  std::string source;           ///< the trajectory's file name
  std::string unit;             ///< of lengths, as it follows a number
  double cutoff = 0, skin = 0;  ///< [length]
  std::int64_t frames = 0;      ///< to come
};

/// Writes a page that shows atoms, contacts and the levels of the hierarchy in space, frame by frame: only
/// the frame at hand is held in memory. The page needs WebGL, and nothing from outside.
///
/// Each frame is an object of JSON whose `data` is a deflated stream in base64 of whole numbers, seven bits a
/// byte, the lowest first: for each atom its place along x, y and z, in 65,535ths between `low` and `high`;
/// the rows of contacts; then, level by level from 0, the nodes (but for level 0) as steps from one to the
/// next, one more than the place of each node's parent in the next level, or 0 for a root, and the rows of
/// edges (but for level 0). A row is a count, and steps from the row's number to its neighbors.
class ViewPage {
 public:
  static constexpr std::size_t kMaxBytes = 64u << 20;   ///< what browsers open
  static constexpr std::int64_t kMaxDrawn = 2'000'000;  ///< atoms, nodes, contacts or edges of a frame

  /// @throws as open_output
  ViewPage(const std::string& path, const ViewHeader& header);

  /// @throws UsageError if the page gets too large or a frame has too much to draw; trajectory::FileError,
  /// the
  ///   disk being full, say.
  void append(const ViewedFrame& frame);
  /// Completes the page and gives it its name. @throws trajectory::FileError.
  void commit();

 private:
  void write(const std::string& text);
  void require_drawable(const ViewedFrame& frame) const;
  [[noreturn]] void fail_too_large() const;

  OutputFile file_;
  std::int64_t frames_expected_;
  std::int64_t frames_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace dch::cli

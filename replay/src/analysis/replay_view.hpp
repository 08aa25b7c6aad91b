// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include <dch/base/executor.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/trajectory/frame.hpp>

#include "analysis/replay.hpp"
#include "engines/viewed_hierarchy.hpp"
#include "input/frame_stream.hpp"
#include "report/view_page.hpp"

namespace dch::cli {

/// The page of a replay that shows its frames in space, if one was asked for; else nothing is done.
class ReplayView {
 public:
  /// Opens the page. @throws trajectory::FileError if it cannot be written.
  ReplayView(const ReplayOptions& options, const Scan& scan);

  /// @param threads to keep the hierarchy and make its lists with; null for one
  void start(Executor* threads);
  /// @param index of the frame in the file
  /// @throws as in_frame and ViewPage::append
  void append(const trajectory::Frame& frame, std::int64_t index, const ListParams& params);
  /// @throws trajectory::FileError
  void commit();

 private:
  const ReplayOptions& options_;
  std::optional<ViewPage> page_;
  std::optional<ViewedHierarchy> hierarchy_;
};

}  // namespace dch::cli

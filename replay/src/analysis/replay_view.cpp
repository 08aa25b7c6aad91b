// SPDX-License-Identifier: MIT
#include "analysis/replay_view.hpp"

#include "analysis/frame_errors.hpp"

namespace dch::cli {

ReplayView::ReplayView(const ReplayOptions& options, const Scan& scan) : options_(options) {
  if (options.view.empty()) return;
  ViewHeader header;
  header.source = options.input.name();
  header.unit = unit_suffix(scan.unit);
  header.cutoff = options.cutoff;
  header.skin = options.skin;
  header.frames = scan.frames;
  page_.emplace(options.view, header);
}

void ReplayView::start(Executor* threads) {
  if (!page_) return;
  HierarchyParams params;
  params.radius = options_.cutoff + options_.skin;
  params.policy = options_.engine.policy;
  params.executor = threads;
  hierarchy_.emplace(params);
}

void ReplayView::append(const trajectory::Frame& frame, std::int64_t index, const ListParams& params) {
  if (!page_) return;
  page_->append(
      *in_frame(options_.input.name(), index, [&] { return &hierarchy_->take(frame, index, params); }));
}

void ReplayView::commit() {
  if (page_) page_->commit();
}

}  // namespace dch::cli

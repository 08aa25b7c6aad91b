// SPDX-License-Identifier: MIT
#include "report/contact_report.hpp"

#include <algorithm>

namespace dch::cli {

void EventSummary::add(Span<const necklace::ContactEvent> events) {
  for (const necklace::ContactEvent& event : events) {
    ++events_;
    begun_before_ += event.begun_before ? 1 : 0;
    not_ended_ += event.not_ended ? 1 : 0;
    longest_ = std::max(longest_, event.duration());
    if (event.begun_before || event.not_ended) continue;
    ++complete_;
    duration_ += event.duration();
    const auto frames = static_cast<std::size_t>(event.frames);
    if (by_frames_.size() <= frames) by_frames_.resize(frames + 1);
    ++by_frames_[frames];
  }
}

FrameSpread ContactReport::contacts() const {
  FrameSpread spread;
  if (frames.empty()) return spread;
  spread.least = frames.front().contacts();
  for (const ContactFrame& frame : frames) {
    spread.least = std::min(spread.least, frame.contacts());
    spread.most = std::max(spread.most, frame.contacts());
    spread.mean += static_cast<double>(frame.contacts()) / static_cast<double>(frames.size());
  }
  return spread;
}

std::int64_t ContactReport::frames_by(necklace::Structure which) const {
  return std::count_if(frames.begin(), frames.end(),
                       [&](const ContactFrame& frame) { return frame.by == which; });
}

std::string pairs_text(const necklace::ContactQuery& query) {
  if (query.within_chains && query.between_chains) return "all";
  return query.within_chains ? "within" : "between";
}

}  // namespace dch::cli

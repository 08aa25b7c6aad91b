// SPDX-License-Identifier: MIT
#include "report/replay_report.hpp"

#include <algorithm>

namespace dch::cli {

ReplayTotals ReplayReport::totals() const {
  ReplayTotals sum;
  if (frames.empty()) return sum;
  sum.pairs_min = sum.pairs_max = frames.front().pairs;
  for (const FrameRecord& frame : frames) {
    sum.pairs_min = std::min(sum.pairs_min, frame.pairs);
    sum.pairs_max = std::max(sum.pairs_max, frame.pairs);
    sum.pairs_mean += static_cast<double>(frame.pairs);
    sum.list_rebuilds += frame.list_rebuilt ? 1 : 0;
    sum.refreshes += frame.refreshes;
    sum.repairs += frame.repairs;
    sum.rebuilds += frame.rebuilds;
    sum.promotions += frame.promotions;
    sum.demotions += frame.demotions;
    sum.read_ms += frame.read_ms;
    sum.maintain_ms += frame.maintain_ms;
    sum.list_ms += frame.list_ms;
  }
  sum.pairs_mean /= static_cast<double>(frames.size());
  return sum;
}

std::string to_string(ListKind kind) { return kind == ListKind::half ? "half" : "full"; }

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "report/summary_json.hpp"

#include <cmath>

#include "base/version.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kSchemaVersion = 2;

}  // namespace

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json begin_report(const TrajectorySummary& summary, std::size_t frames) {
  return {{"schema", kSchemaVersion},
          {"version", kVersion},
          {"file", summary.file},
          {"format", summary.format},
          {"unit", summary.unit},
          {"frames", frames},
          {"frames_read", summary.frames_passed},
          {"atoms", summary.most_atoms},
          {"fewest_atoms", summary.fewest_atoms},
          {"box_kinds", summary.box_kinds},
          {"smallest_box_height", number_or_null(summary.smallest_height)}};
}

}  // namespace dch::cli

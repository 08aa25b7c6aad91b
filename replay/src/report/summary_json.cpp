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

Json begin_report() { return {{"schema", kSchemaVersion}, {"version", kVersion}}; }

Json begin_report(const TrajectorySummary& summary, std::size_t frames) {
  Json json = begin_report();
  json["file"] = summary.file;
  json["format"] = summary.format;
  json["unit"] = summary.unit;
  json["frames"] = frames;
  json["frames_read"] = summary.frames_passed;
  json["atoms"] = summary.most_atoms;
  json["fewest_atoms"] = summary.fewest_atoms;
  json["box_kinds"] = summary.box_kinds;
  json["smallest_box_height"] = number_or_null(summary.smallest_height);
  return json;
}

}  // namespace dch::cli

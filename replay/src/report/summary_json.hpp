// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "input/trajectory_summary.hpp"

namespace dch::cli {

/// JSON has no infinity and no NaN.
nlohmann::ordered_json number_or_null(double value);

/// How any report begins: the number of the schema and the version of the command.
nlohmann::ordered_json begin_report();

/// How the report of a trajectory begins, as docs/report-schema.md describes it. @param frames in the report
nlohmann::ordered_json begin_report(const TrajectorySummary& summary, std::size_t frames);

/// One value of each frame of a report as an array.
template <class Report, class Value>
nlohmann::ordered_json column(const Report& report, const Value& value) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const auto& frame : report.frames) array.push_back(value(frame));
  return array;
}

}  // namespace dch::cli

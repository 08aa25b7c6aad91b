// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "replay_report.hpp"

namespace dch::cli {

/// A line of the final table.
struct Row {
  std::string name, value;
};

/// The final table, on the terminal and in report.html.
std::vector<Row> report_rows(const ReplayReport& report);

std::string engine_text(const EngineOptions& engine);
std::string list_text(const ReplayReport& report);
/// The unit as it follows a number: "nm", but "[the dump's unit]".
std::string unit_suffix(const std::string& unit);

}  // namespace dch::cli

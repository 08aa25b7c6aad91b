// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/replay_report.hpp"

namespace dch::cli {

/// A line of the final table.
struct Row {
  std::string name, value;
};

/// The final table, on the terminal and in report.html.
std::vector<Row> report_rows(const ReplayReport& report);

/// Rows as text in two columns.
std::string render_rows(const std::vector<Row>& rows);

std::string engine_text(const EngineOptions& engine);
std::string list_text(const ReplayReport& report);

}  // namespace dch::cli

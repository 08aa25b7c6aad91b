// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
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

/// Rows as text in two columns.
std::string render_rows(const std::vector<Row>& rows);

/// The kinds of box of a trajectory, and its smallest height if it is finite.
std::string box_text(const std::vector<std::string>& kinds, double smallest_height, std::int64_t frame,
                     const std::string& unit);
std::string engine_text(const EngineOptions& engine);
std::string list_text(const ReplayReport& report);
/// The unit as it follows a number: "nm", but "[the dump's unit]".
std::string unit_suffix(const std::string& unit);

}  // namespace dch::cli

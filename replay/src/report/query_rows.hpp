// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "report/query_report.hpp"
#include "report/report_rows.hpp"

namespace dch::cli {

/// The final table of `dchmd query`, on the terminal and on its page.
std::vector<Row> query_rows(const QueryReport& report);

}  // namespace dch::cli

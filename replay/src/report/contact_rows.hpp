// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "report/contact_report.hpp"
#include "report/report_rows.hpp"

namespace dch::cli {

/// The final table of `dchmd contacts`, on the terminal and on its page.
std::vector<Row> contact_rows(const ContactReport& report);

}  // namespace dch::cli

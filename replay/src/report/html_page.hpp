// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report/report_rows.hpp"

namespace dch::cli {

/// The parts of a page that needs nothing from outside. Texts are escaped, drawings and other parts of a page
/// are not.
struct HtmlPage {
  std::string command;  ///< "replay"
  std::string file;     ///< the trajectory
  std::string heading;  ///< "Neighbor lists of"; the file's name follows
  std::string verdict;  ///< beside the heading; may be empty
  std::vector<Row> table;
  std::string notes;   ///< between table and cards; may be empty
  std::string charts;  ///< cards
};

std::string render_page(const HtmlPage& page);

/// A drawing with a title and a sentence or two.
std::string html_card(const std::string& title, const std::string& explanation, const std::string& drawing);

}  // namespace dch::cli

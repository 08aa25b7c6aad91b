// SPDX-License-Identifier: MIT
// The page of `dchmd contacts`: the table, the contact map, P(s), contacts over the frames and how long they
// lasted.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/number_text.hpp"
#include "plot/svg_chart.hpp"
#include "report/contact_report.hpp"
#include "report/contact_rows.hpp"
#include "report/html_page.hpp"

namespace dch::cli {
namespace {

constexpr std::size_t kMaxCells = 160;       ///< along a side of the map as drawn
constexpr std::size_t kMaxChainsDrawn = 64;  ///< more would hide the map

/// The first bin of a group, of bins that are merged into groups to draw them.
std::size_t first_bin(std::size_t group, std::size_t groups, std::size_t bins) {
  return group * bins / groups;
}

/// Contacts over pairs of two groups of bins, NaN without a pair.
double group_frequency(const necklace::ContactMap& map, std::size_t a, std::size_t b, std::size_t groups) {
  std::int64_t contacts = 0;
  double pairs = 0;
  for (std::size_t p = first_bin(a, groups, map.bins()); p < first_bin(a + 1, groups, map.bins()); ++p) {
    for (std::size_t q = first_bin(b, groups, map.bins()); q < first_bin(b + 1, groups, map.bins()); ++q) {
      if (a == b && q < p) continue;  // each pair of bins once
      contacts += map.contacts(p, q);
      pairs += static_cast<double>(map.pairs(p, q));
    }
  }
  if (pairs == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(contacts) / (pairs * static_cast<double>(map.frames()));
}

std::string map_card(const ContactReport& report) {
  const std::size_t groups = std::min(report.map.bins(), kMaxCells);
  HeatMap drawn;
  drawn.axis_label = "bead, along the chains";
  for (std::size_t group = 0; group <= groups; ++group) {
    drawn.edges.push_back(report.map.first_place(first_bin(group, groups, report.map.bins())));
  }
  drawn.values.resize(groups * groups);
  for (std::size_t a = 0; a < groups; ++a) {
    for (std::size_t b = a; b < groups; ++b) {
      drawn.values[a * groups + b] = drawn.values[b * groups + a] = group_frequency(report.map, a, b, groups);
    }
  }
  if (report.chain_ends.size() - 1 <= kMaxChainsDrawn) {
    for (std::size_t chain = 1; chain + 1 < report.chain_ends.size(); ++chain) {
      drawn.lines.push_back(report.chain_ends[chain]);
    }
  }
  std::string text =
      "How often two beads are in contact: the part of the pairs of beads of a cell that is, as a mean over "
      "the frames.";
  if (!drawn.lines.empty()) text += " Lines part chains.";
  return html_card("Contact map", text, heat_map(drawn));
}

std::string probability_card(const ContactReport& report) {
  LogChart chart;
  chart.x_label = "s, bonds between the beads";
  chart.y_label = "P(s)";
  for (const necklace::SeparationRange& range : report.probability.ranges(kRangesPerDecade)) {
    const double s = std::sqrt(static_cast<double>(range.first) * range.last);
    const std::string which = range.first == range.last
                                  ? fmt::format("s = {}", grouped(range.first))
                                  : fmt::format("s = {} to {}", grouped(range.first), grouped(range.last));
    chart.points.push_back({s, range.probability, fmt::format("{}: {}", which, readable(range.probability))});
  }
  if (chart.points.empty()) return "";
  return html_card(
      "P(s)",
      "Probability of contact of two beads of a chain, against the number of bonds between them. "
      "Separations without a contact are not drawn.",
      log_log_chart(chart));
}

std::string frames_card(const ContactReport& report) {
  FrameChart chart;
  chart.x_label = "frame";
  chart.y_label = "contacts";
  Series within{"within a chain", "blue", {}}, between{"between chains", "amber", {}};
  for (const ContactFrame& frame : report.frames) {
    chart.x.push_back(static_cast<double>(frame.frame));
    within.y.push_back(static_cast<double>(frame.within));
    between.y.push_back(static_cast<double>(frame.between));
  }
  if (report.query.within_chains) chart.series.push_back(within);
  if (report.query.between_chains) chart.series.push_back(between);
  const std::string note = group_note(report.frames.size());
  return html_card("Contacts of a frame",
                   "Pairs of beads in contact." + (note.empty() ? "" : " Here " + note + "."),
                   line_chart(chart));
}

std::string duration_card(const ContactReport& report) {
  const std::vector<std::int64_t>& counts = report.events.by_frames();
  LogChart chart;
  chart.x_label = "frames in a row";
  chart.y_label = "events";
  for (std::size_t first = 1; first < counts.size();) {
    const auto end = std::min(
        counts.size(), std::max(first + 1, static_cast<std::size_t>(static_cast<double>(first) *
                                                                    std::pow(10, 1.0 / kRangesPerDecade))));
    std::int64_t events = 0;
    for (std::size_t k = first; k < end; ++k) events += counts[k];
    const double mean = static_cast<double>(events) / static_cast<double>(end - first);
    const double middle = std::sqrt(static_cast<double>(first) * static_cast<double>(end - 1));
    chart.points.push_back(
        {middle, mean, fmt::format("{} to {} frames: {}", first, end - 1, counted(events, "event"))});
    first = end;
  }
  if (chart.points.empty()) return "";
  return html_card(
      "Duration of contacts",
      "How many contacts that began and ended within the frames lasted for how many frames; where "
      "numbers of frames are taken together, their mean.",
      log_log_chart(chart));
}

}  // namespace

std::string render_html(const ContactReport& report) {
  HtmlPage page;
  page.command = "contacts";
  page.file = report.file;
  page.heading = "Contacts of";
  page.table = contact_rows(report);
  page.charts = map_card(report) + probability_card(report) + frames_card(report) + duration_card(report);
  return render_page(page);
}

}  // namespace dch::cli

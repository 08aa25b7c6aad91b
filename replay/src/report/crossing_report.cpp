// SPDX-License-Identifier: MIT
#include "report/crossing_report.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "plot/svg_chart.hpp"
#include "report/html_page.hpp"

namespace dch::cli {
namespace {

std::string event_text(const CrossingEvent& event) {
  return fmt::format("frame {}: bonds {}-{} and {}-{}, {:.3f} of the step, {}", event.frame, event.p[0],
                     event.p[1], event.q[0], event.q[1], event.crossing.time,
                     event.crossing.sign == 0  ? "no sign"
                     : event.crossing.sign > 0 ? "sign +1"
                                               : "sign -1");
}

std::string filter_text(const necklace::CrossingStats& stats) {
  if (stats.near_pairs == 0) return "no near pairs of bonds";
  const auto share = [&](std::int64_t count) {
    return 100 * static_cast<double>(count) / static_cast<double>(stats.near_pairs);
  };
  return fmt::format(
      "{} near pairs: ball rejects {:.1f} %, box {:.1f} %, zonotope {:.1f} %; {} decided by integers",
      grouped(stats.near_pairs), share(stats.by_ball), share(stats.by_box), share(stats.by_zonotope),
      grouped(stats.exact));
}

std::string undetermined_text(const CrossingReport& report) {
  const UndeterminedEvent& first = *report.first_undetermined;
  return fmt::format("{}; first in frame {}: the bond of the atoms {} and {} {}",
                     grouped(report.undetermined), first.frame, first.bond[0], first.bond[1],
                     reason_text(first.reason));
}

}  // namespace

double CrossingReport::search_ms() const {
  double sum = 0;
  for (const CrossingFrame& frame : frames) sum += frame.search_ms;
  return sum;
}

std::string reason_text(necklace::UndeterminedBond::Reason reason) {
  return reason == necklace::UndeterminedBond::Reason::bond_too_long
             ? "is half the smallest box height long or more"
             : "has an atom that moved half the smallest box height or more";
}

std::vector<Row> crossing_rows(const CrossingReport& report) {
  std::vector<Row> rows = {
      {"file", fmt::format("{} ({})", report.file, report.format)},
      {"frames", grouped(static_cast<std::int64_t>(report.frames.size()))},
      {"box", box_text(report)},
      {"chains", fmt::format("{}, {} of them rings, {} bonds (from {})", grouped(report.chains),
                             grouped(report.rings), grouped(report.bonds), report.topology)},
      {"crossings", report.crossings == 0
                        ? "none"
                        : fmt::format("{}, {} of sign +1 and {} of sign -1", grouped(report.crossings),
                                      grouped(report.positive), grouped(report.negative))}};
  if (!report.events.empty()) rows.push_back({"first", event_text(report.events.front())});
  if (report.thickness > 0 || report.contacts > 0) {
    rows.push_back({"contacts", fmt::format("{} within {} {}", grouped(report.contacts),
                                            readable(report.thickness), unit_suffix(report.unit))});
  }
  if (report.first_undetermined) rows.push_back({"undetermined", undetermined_text(report)});
  rows.push_back({"filters", filter_text(report.stats)});
  if (report.search_ms() > 0 && report.stats.bonds > 0) {
    rows.push_back(
        {"bonds a second", readable(1e3 * static_cast<double>(report.stats.bonds) / report.search_ms())});
  }
  return rows;
}

std::string render_table(const CrossingReport& report) { return render_rows(crossing_rows(report)); }

std::string render_html(const CrossingReport& report) {
  HtmlPage page;
  page.command = "crossings";
  page.file = report.file;
  page.heading = "Bonds that cross in";
  page.verdict = report.crossings > 0      ? counted(report.crossings, "crossing")
                 : report.undetermined > 0 ? "undetermined"
                                           : "no crossing";
  page.table = crossing_rows(report);
  FrameChart chart;
  chart.x_label = "frame";
  chart.y_label = "crossings";
  chart.series = {{"crossings", "amber", {}}};
  for (const CrossingFrame& frame : report.frames) {
    chart.x.push_back(static_cast<double>(frame.frame));
    chart.series[0].y.push_back(static_cast<double>(frame.crossings));
  }
  page.charts = html_card("Crossings", "In the step to each frame. " + group_note(report.frames.size()),
                          line_chart(chart));
  if (!report.events.empty()) {
    std::string list = "<ol>";
    constexpr std::size_t kShown = 200;
    for (std::size_t k = 0; k < std::min(report.events.size(), kShown); ++k)
      list += "<li>" + escape_html(event_text(report.events[k])) + "</li>";
    page.charts +=
        html_card("Events", report.crossings > static_cast<std::int64_t>(kShown) ? "The first 200." : "",
                  list + "</ol>");
  }
  return render_page(page);
}

}  // namespace dch::cli

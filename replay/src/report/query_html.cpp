// SPDX-License-Identifier: MIT
// The page of `dchmd query`: the table, distances of the nearest atoms, the closest pair over the frames,
// clusters at every cutoff, and their sizes.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "plot/svg_chart.hpp"
#include "report/html_page.hpp"
#include "report/query_report.hpp"
#include "report/query_rows.hpp"

namespace dch::cli {
namespace {

constexpr std::array<const char*, 4> kColors = {"blue", "amber", "green", "red"};

std::string nearest_card(const QueryReport& report) {
  FrameChart chart;
  chart.x_label = "neighbor, by its rank";
  chart.y_label = "distance";
  chart.series = {{"largest", "amber", {}}, {"mean", "blue", {}}, {"smallest", "green", {}}};
  for (std::size_t rank = 0; rank < report.nearest.size(); ++rank) {
    const LengthSpread& spread = report.nearest[rank];
    if (spread.count() == 0) break;
    chart.x.push_back(static_cast<double>(rank + 1));
    chart.series[0].y.push_back(spread.most());
    chart.series[1].y.push_back(spread.mean());
    chart.series[2].y.push_back(spread.least());
  }
  if (chart.x.size() < 2) return "";
  return html_card("Nearest atoms",
                   "Distance of the nearest atom, of the second nearest, and so on, over all atoms.",
                   line_chart(chart));
}

std::string note_on_groups(std::size_t frames) {
  const std::string note = group_note(frames);
  return note.empty() ? "" : " Here " + note + ".";
}

std::string closest_card(const QueryReport& report) {
  FrameChart chart;
  chart.x_label = "frame";
  chart.y_label = "distance";
  chart.series = {{"closest pair", "blue", {}}};
  for (const QueryFrame& frame : report.frames) {
    if (!frame.closest) continue;
    chart.x.push_back(static_cast<double>(frame.frame));
    chart.series[0].y.push_back(frame.closest->distance);
  }
  if (chart.x.empty()) return "";
  return html_card("Closest pair",
                   "Distance of the two atoms nearest each other." + note_on_groups(chart.x.size()),
                   line_chart(chart));
}

std::string curve_card(const QueryReport& report) {
  LogChart chart;
  chart.x_label = "cutoff";
  chart.y_label = "clusters";
  for (const ClusterCurve::Point& point : report.curve.points()) {
    chart.points.push_back({point.cutoff, point.clusters,
                            fmt::format("{}: {}", readable(point.cutoff), readable(point.clusters))});
  }
  if (chart.points.empty()) return "";
  return html_card(
      "Clusters at every cutoff",
      "How many clusters a frame has, as a mean: atoms joined by steps no longer than the cutoff.",
      log_log_chart(chart));
}

std::string largest_card(const QueryReport& report) {
  FrameChart chart;
  chart.x_label = "frame";
  chart.y_label = "atoms";
  for (const QueryFrame& frame : report.frames) chart.x.push_back(static_cast<double>(frame.frame));
  for (std::size_t k = 0; k < std::min(report.cutoffs.size(), kColors.size()); ++k) {
    Series series{fmt::format("at {}", readable(report.cutoffs[k])), kColors[k], {}};
    for (const QueryFrame& frame : report.frames) series.y.push_back(static_cast<double>(frame.largest[k]));
    chart.series.push_back(series);
  }
  std::string text = "Atoms of the largest cluster.";
  if (report.cutoffs.size() > kColors.size()) text += fmt::format(" The first {} cutoffs.", kColors.size());
  return html_card("Largest cluster", text + note_on_groups(report.frames.size()), line_chart(chart));
}

std::string sizes_card(const QueryReport& report, std::size_t cutoff) {
  LogChart chart;
  chart.x_label = "atoms of a cluster";
  chart.y_label = "clusters";
  for (const auto& [size, number] : report.sizes[cutoff]) {
    chart.points.push_back({static_cast<double>(size), static_cast<double>(number),
                            fmt::format("{}: {}", counted(size, "atom"), counted(number, "cluster"))});
  }
  return html_card(fmt::format("Sizes of clusters at {}", readable(report.cutoffs[cutoff])),
                   "How many clusters have how many atoms, over all frames.", log_log_chart(chart));
}

}  // namespace

std::string render_html(const QueryReport& report) {
  HtmlPage page;
  page.command = "query";
  page.file = report.file;
  page.heading = "Proximity in";
  page.table = query_rows(report);
  page.charts = nearest_card(report) + closest_card(report);
  if (!report.cutoffs.empty()) page.charts += curve_card(report) + largest_card(report);
  for (std::size_t k = 0; k < std::min(report.cutoffs.size(), kColors.size()); ++k) {
    page.charts += sizes_card(report, k);
  }
  return render_page(page);
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
// report.html: the table and drawings over the frames.
#include <algorithm>
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "plot/svg_chart.hpp"
#include "report/html_page.hpp"
#include "report/replay_report.hpp"
#include "report/report_rows.hpp"

namespace dch::cli {
namespace {

template <class Value>
std::vector<double> frame_values(const ReplayReport& report, Value value) {
  std::vector<double> values;
  for (const FrameRecord& frame : report.frames) values.push_back(static_cast<double>(value(frame)));
  return values;
}

FrameChart frame_chart(const ReplayReport& report, const std::string& y_label) {
  FrameChart chart;
  chart.x_label = "frame";
  chart.y_label = y_label;
  chart.x = frame_values(report, [](const FrameRecord& frame) { return frame.frame; });
  return chart;
}

/// The explanation, with a remark if frames were merged to draw them.
std::string explained(const ReplayReport& report, const std::string& text) {
  const std::string note = group_note(report.frames.size());
  return note.empty() ? text : text + " Here " + note + ".";
}

std::string pairs_card(const ReplayReport& report) {
  FrameChart chart = frame_chart(report, "pairs");
  chart.series = {
      {"pairs", "blue", frame_values(report, [](const FrameRecord& frame) { return frame.pairs; })}};
  const std::string radius = fmt::format("{} {}", report.cutoff + report.skin, unit_suffix(report.unit));
  const std::string text =
      report.skin > 0
          ? fmt::format(
                "Pairs in the list: those within cutoff + skin = {} when it was built last. It was "
                "built in {} of {}.",
                radius, grouped(report.totals().list_rebuilds),
                counted(static_cast<std::int64_t>(report.frames.size()), "frame"))
          : fmt::format("Pairs of atoms within the cutoff of {}.", radius);
  return html_card("Pairs", explained(report, text), line_chart(chart));
}

std::string cost_card(const ReplayReport& report) {
  FrameChart chart = frame_chart(report, "ms");
  chart.series = {
      {"read", "amber", frame_values(report, [](const FrameRecord& frame) { return frame.read_ms; })},
      {"maintain", "blue", frame_values(report, [](const FrameRecord& frame) { return frame.maintain_ms; })},
      {"list", "green", frame_values(report, [](const FrameRecord& frame) { return frame.list_ms; })}};
  return html_card(
      "Cost of a frame",
      explained(report,
                "Wall-clock time to read the frame, to bring the search structure up to date, and to "
                "write the list from it."),
      stacked_bars(chart));
}

std::string changes_card(const ReplayReport& report) {
  if (report.levels.empty()) return "";
  FrameChart chart = frame_chart(report, "nodes");
  chart.series = {
      {"promoted", "blue", frame_values(report, [](const FrameRecord& frame) { return frame.promotions; })},
      {"demoted", "amber", frame_values(report, [](const FrameRecord& frame) { return frame.demotions; })}};
  for (const FrameRecord& frame : report.frames) chart.marked.push_back(frame.rebuilds > 0);
  chart.mark_name = "built anew";
  const ReplayTotals totals = report.totals();
  return html_card(
      "Repairs",
      explained(report,
                fmt::format("Nodes of the hierarchy lifted (up) and removed from (down) a level as the "
                            "atoms moved: {}, {} from scratch, {} that needed neither.",
                            counted(totals.repairs, "repair"), counted(totals.rebuilds, "build"),
                            counted(totals.refreshes, "update"))),
      up_down_bars(chart));
}

std::string levels_card(const ReplayReport& report) {
  if (report.levels.empty()) return "";
  std::vector<LabelledBar> bars;
  for (std::size_t level = 0; level < report.levels.size(); ++level) {
    const LevelInfo& info = report.levels[level];
    LabelledBar bar;
    bar.label = fmt::format("level {}", level);
    bar.note = counted(info.nodes, "node");
    if (info.edges >= 0) bar.note += ", " + counted(info.edges, "edge");
    bar.value = static_cast<double>(info.nodes);
    bars.push_back(bar);
  }
  return html_card(
      "Levels",
      "Nodes in each level of the hierarchy after the last frame. The edges of level 0 are the list.",
      logarithmic_bars(bars, "nodes (logarithmic)"));
}

std::string degree_card(const ReplayReport& report) {
  double atoms = 0, neighbors = 0;
  for (std::size_t k = 0; k < report.degree_histogram.size(); ++k) {
    const auto count = static_cast<double>(report.degree_histogram[k]);
    atoms += count;
    neighbors += count * static_cast<double>(k);
  }
  if (atoms == 0) return "";
  std::vector<double> shares;
  for (const std::int64_t count : report.degree_histogram)
    shares.push_back(100 * static_cast<double>(count) / atoms);
  return html_card("Neighbors of an atom",
                   "How many atoms have how many neighbors in the list, over all frames.",
                   histogram(shares, neighbors / atoms, "neighbors", "% of atoms"));
}

/// Counts by percent as shares.
std::string percent_card(const std::string& title, const std::string& text, const std::string& x_label,
                         const BetweenReport::Histogram& counts) {
  double all = 0, sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    all += static_cast<double>(counts[k]);
    sum += static_cast<double>(counts[k]) * static_cast<double>(k);
  }
  if (all == 0) return "";
  std::vector<double> shares;
  for (const std::int64_t count : counts) shares.push_back(100 * static_cast<double>(count) / all);
  return html_card(title, text, histogram(shares, sum / all, x_label, "% of them"));
}

std::string between_cards(const BetweenReport& between) {
  FrameChart chart;
  chart.x_label = "frame before";
  chart.y_label = "contacts";
  chart.series = {{"hidden", "amber", {}}, {"come", "blue", {}}, {"go", "green", {}}};
  for (const IntervalRecord& interval : between.intervals) {
    chart.x.push_back(static_cast<double>(interval.frame));
    chart.series[0].y.push_back(static_cast<double>(interval.hidden));
    chart.series[1].y.push_back(static_cast<double>(interval.come));
    chart.series[2].y.push_back(static_cast<double>(interval.go));
    chart.marked.push_back(!interval.undetermined.empty());
  }
  chart.mark_name = "not followed";
  const std::string note = group_note(between.intervals.size());
  return html_card(
             "Between frames",
             "Contacts that come and go between two frames, and those that are hidden: neither frame shows "
             "them. Atoms move in straight lines." +
                 (note.empty() ? "" : " Here " + note + "."),
             line_chart(chart)) +
         percent_card("How close hidden contacts come", "Least distance, as a share of the cutoff.",
                      "% of the cutoff", between.distances) +
         percent_card("How long hidden contacts last", "As a share of the time between two frames.",
                      "% of the interval", between.durations);
}

std::string verdict(const VerifyResult& verify) {
  if (verify.mode == VerifyMode::none)
    return "<p class=\"verdict plain\">lists not verified in this run</p>\n";
  if (verify.mismatches == 0) {
    return fmt::format("<p class=\"verdict good\">0 mismatches in {} verified</p>\n",
                       counted(static_cast<std::int64_t>(verify.frames.size()), "frame"));
  }
  return fmt::format("<p class=\"verdict bad\">{}</p>\n",
                     verify.mismatches == 1 ? "1 mismatch" : grouped(verify.mismatches) + " mismatches");
}

std::string mismatch_list(const ReplayReport& report) {
  if (report.verify.first.empty()) return "";
  std::string items;
  for (const Mismatch& mismatch : report.verify.first) {
    items += fmt::format("<li>{}</li>\n", escape_html(mismatch.message(report.unit)));
  }
  return fmt::format(
      "<section class=\"card wide\">\n<h2>Mismatches</h2>\n<p>The first {} of {}.</p>\n<ul>\n{}</ul>\n"
      "</section>\n",
      report.verify.first.size(), grouped(report.verify.mismatches), items);
}

}  // namespace

std::string render_html(const ReplayReport& report) {
  HtmlPage page;
  page.command = "replay";
  page.file = report.file;
  page.heading = "Neighbor lists of";
  page.verdict = verdict(report.verify);
  page.table = report_rows(report);
  page.notes = mismatch_list(report);
  page.charts = pairs_card(report) + (report.between ? between_cards(*report.between) : "") +
                cost_card(report) + changes_card(report) + degree_card(report) + levels_card(report);
  return render_page(page);
}

}  // namespace dch::cli

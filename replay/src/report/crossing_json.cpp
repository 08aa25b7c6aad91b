// SPDX-License-Identifier: MIT
// report.json of `dchmd crossings`. docs/report-schema.md describes every key; change both together.
#include <nlohmann/json.hpp>

#include "report/crossing_report.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;

Json events_json(const CrossingReport& report) {
  Json events = Json::array();
  for (const CrossingEvent& event : report.events) {
    const necklace::Crossing& c = event.crossing;
    events.push_back({{"frame", event.frame},
                      {"bond_p", event.p},
                      {"bond_q", event.q},
                      {"time", c.time},
                      {"on_p", c.on_p},
                      {"on_q", c.on_q},
                      {"place", {c.place.x, c.place.y, c.place.z}},
                      {"sign", c.sign}});
  }
  return events;
}

Json undetermined_json(const CrossingReport& report) {
  if (!report.first_undetermined) return nullptr;
  const UndeterminedEvent& first = *report.first_undetermined;
  return {{"frame", first.frame}, {"bond", first.bond}, {"reason", reason_text(first.reason)}};
}

Json per_frame_json(const CrossingReport& report) {
  Json json = Json::object();
  json["frame"] = column(report, [](const CrossingFrame& f) { return f.frame; });
  json["step"] = column(report, [](const CrossingFrame& f) { return f.step; });
  json["time"] =
      column(report, [](const CrossingFrame& f) { return f.time ? number_or_null(*f.time) : Json(nullptr); });
  json["crossings"] = column(report, [](const CrossingFrame& f) { return f.crossings; });
  json["contacts"] = column(report, [](const CrossingFrame& f) { return f.contacts; });
  json["undetermined"] = column(report, [](const CrossingFrame& f) { return f.undetermined; });
  json["read_ms"] = column(report, [](const CrossingFrame& f) { return f.read_ms; });
  json["search_ms"] = column(report, [](const CrossingFrame& f) { return f.search_ms; });
  return json;
}

}  // namespace

std::string render_json(const CrossingReport& report) {
  const necklace::CrossingStats& stats = report.stats;
  Json json = begin_report(report, report.frames.size());
  json["topology"] = report.topology;
  json["chains"] = {
      {"number", report.chains}, {"rings", report.rings}, {"beads", report.beads}, {"bonds", report.bonds}};
  json["thickness"] = report.thickness;
  json["crossings"] = {
      {"number", report.crossings}, {"positive", report.positive}, {"negative", report.negative}};
  json["contacts"] = report.contacts;
  json["undetermined"] = {{"number", report.undetermined}, {"first", undetermined_json(report)}};
  json["pairs"] = {{"near", stats.near_pairs},         {"by_ball", stats.by_ball},   {"by_box", stats.by_box},
                   {"by_zonotope", stats.by_zonotope}, {"by_cubic", stats.by_cubic}, {"exact", stats.exact},
                   {"wide_bonds", stats.wide}};
  json["threads"] = report.threads;
  json["timings_ms"] = {
      {"check_file", report.scan_ms}, {"write", report.write_ms}, {"total", report.total_ms}};
  json["events"] = events_json(report);
  json["per_frame"] = per_frame_json(report);
  constexpr int kIndent = 1;  // file names need not be UTF-8, JSON has to be
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dch::cli

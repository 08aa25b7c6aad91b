// SPDX-License-Identifier: MIT
// report.json of `dchmd contacts`. docs/report-schema.md describes every key; change both together.
#include <nlohmann/json.hpp>

#include "report/contact_report.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;

Json input_json(const ContactReport& report) {
  Json json = begin_report(report, report.frames.size());
  json["topology"] = report.topology;
  json["chains"] = {{"number", report.chains},
                    {"rings", report.rings},
                    {"beads", report.beads},
                    {"shortest", report.shortest_chain},
                    {"longest", report.longest_chain}};
  json["radii"] = {{"smallest", report.smallest_radius}, {"largest", report.largest_radius}};
  json["gap"] = report.query.gap;
  json["skip_bonds"] = report.query.skip_bonds;
  json["pairs"] = pairs_text(report.query);
  json["time"] = report.has_times ? "time" : "step";
  return json;
}

Json events_json(const EventSummary& events) {
  return {{"number", events.events()},
          {"begun_before", events.begun_before()},
          {"not_ended", events.not_ended()},
          {"complete", events.complete()},
          {"mean_duration", events.complete() > 0 ? Json(events.mean_duration()) : Json(nullptr)},
          {"longest", events.longest()},
          {"by_frames", events.by_frames()}};
}

Json separation_json(const ContactReport& report) {
  Json ranges = Json::array();
  for (const necklace::SeparationRange& range : report.probability.ranges(kRangesPerDecade)) {
    ranges.push_back({{"first", range.first},
                      {"last", range.last},
                      {"contacts", range.contacts},
                      {"pairs", range.pairs},
                      {"probability", number_or_null(range.probability)}});
  }
  return ranges;
}

Json choice_json(const ContactReport& report) {
  const necklace::StructureChoice& choice = report.choice;
  return {{"structure", name_of(choice.structure)},
          {"reason", choice.reason},
          {"visited_per_bead", choice.visited_per_bead < 0 ? Json(nullptr) : Json(choice.visited_per_bead)},
          {"frames_wrapped", report.frames_by(necklace::Structure::wrapped)},
          {"frames_dch", report.frames_by(necklace::Structure::dch)}};
}

Json per_frame_json(const ContactReport& report) {
  Json json = Json::object();  // null would turn into an object, and be neither without memory
  json["frame"] = column(report, [](const ContactFrame& f) { return f.frame; });
  json["step"] = column(report, [](const ContactFrame& f) { return f.step; });
  json["time"] =
      column(report, [](const ContactFrame& f) { return f.time ? number_or_null(*f.time) : Json(nullptr); });
  json["within"] = column(report, [](const ContactFrame& f) { return f.within; });
  json["between"] = column(report, [](const ContactFrame& f) { return f.between; });
  json["by"] = column(report, [](const ContactFrame& f) { return name_of(f.by); });
  json["read_ms"] = column(report, [](const ContactFrame& f) { return f.read_ms; });
  json["update_ms"] = column(report, [](const ContactFrame& f) { return f.update_ms; });
  json["search_ms"] = column(report, [](const ContactFrame& f) { return f.search_ms; });
  json["follow_ms"] = column(report, [](const ContactFrame& f) { return f.follow_ms; });
  return json;
}

}  // namespace

std::string render_json(const ContactReport& report) {
  const FrameSpread spread = report.contacts();
  const necklace::WrappedStats& stats = report.structure;
  Json json = input_json(report);
  json["contacts"] = {{"min", spread.least}, {"mean", spread.mean}, {"max", spread.most}};
  json["events"] = events_json(report.events);
  json["separation"] = separation_json(report);
  json["map_bins"] = report.map.bins();
  json["choice"] = choice_json(report);
  json["structure"] = {{"cages", report.cages},
                       {"updates", stats.updates},
                       {"cages_checked", stats.cages_checked},
                       {"containment_tests", stats.containment_tests},
                       {"escapes", stats.escapes},
                       {"basis_changes", stats.basis_changes}};
  json["threads"] = report.threads;
  json["timings_ms"] = {
      {"check_file", report.scan_ms}, {"write", report.write_ms}, {"total", report.total_ms}};
  json["per_frame"] = per_frame_json(report);
  constexpr int kIndent = 1;  // file names need not be UTF-8, JSON has to be
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dch::cli

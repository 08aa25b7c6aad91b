// SPDX-License-Identifier: MIT
// report.json. docs/report-schema.md describes every key; change both together.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/replay_report.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json input_json(const ReplayReport& report) {
  Json json = begin_report(report, report.frames.size());
  json["engine"] = to_string(report.engine.kind);
  if (report.engine.kind == EngineKind::automatic) json["choice"] = report.choice;
  if (may_keep_hierarchy(report.engine.kind)) json["policy"] = to_string(report.engine.policy);
  if (takes_threads(report.engine.kind)) json["threads"] = report.threads;
  json["list"] = to_string(report.list_kind);
  json["cutoff"] = report.cutoff;
  json["skin"] = report.skin;
  json["exclude"] = {{"rule", text_or_null(report.exclusions.rule)},
                     {"bonds", report.exclusions.bonds},
                     {"bonds_from", text_or_null(report.exclusions.source)},
                     {"pairs", report.exclusions.pairs}};
  return json;
}

Json levels_json(const ReplayReport& report) {
  Json levels = Json::array();
  for (const LevelInfo& level : report.levels) {
    levels.push_back({{"nodes", level.nodes},
                      {"edges", level.edges < 0 ? Json(nullptr) : Json(level.edges)},
                      {"max_degree", level.max_degree},
                      {"covering_radius", level.covering_radius},
                      {"edge_threshold", level.edge_threshold}});
  }
  return levels;
}

Json per_frame_json(const ReplayReport& report) {
  Json json = Json::object();  // null would turn into an object, and be neither without memory
  json["frame"] = column(report, [](const FrameRecord& f) { return f.frame; });
  json["step"] = column(report, [](const FrameRecord& f) { return f.step; });
  json["time"] =
      column(report, [](const FrameRecord& f) { return f.time ? number_or_null(*f.time) : Json(nullptr); });
  json["atoms"] = column(report, [](const FrameRecord& f) { return f.atoms; });
  json["list_rebuilt"] = column(report, [](const FrameRecord& f) { return f.list_rebuilt; });
  json["refreshes"] = column(report, [](const FrameRecord& f) { return f.refreshes; });
  json["repairs"] = column(report, [](const FrameRecord& f) { return f.repairs; });
  json["rebuilds"] = column(report, [](const FrameRecord& f) { return f.rebuilds; });
  json["promotions"] = column(report, [](const FrameRecord& f) { return f.promotions; });
  json["demotions"] = column(report, [](const FrameRecord& f) { return f.demotions; });
  json["levels"] = column(report, [](const FrameRecord& f) { return f.levels; });
  json["read_ms"] = column(report, [](const FrameRecord& f) { return f.read_ms; });
  json["maintain_ms"] = column(report, [](const FrameRecord& f) { return f.maintain_ms; });
  json["list_ms"] = column(report, [](const FrameRecord& f) { return f.list_ms; });
  return json;
}

Json intervals_json(const BetweenReport& between) {
  const auto column = [&](const auto& value) {
    Json array = Json::array();
    for (const IntervalRecord& interval : between.intervals) array.push_back(value(interval));
    return array;
  };
  Json json = Json::object();  // null would turn into an object, and be neither without memory
  json["frame"] = column([](const IntervalRecord& r) { return r.frame; });
  json["next_frame"] = column([](const IntervalRecord& r) { return r.next_frame; });
  json["undetermined"] = column([](const IntervalRecord& r) { return text_or_null(r.undetermined); });
  json["hidden"] = column([](const IntervalRecord& r) { return r.hidden; });
  json["come"] = column([](const IntervalRecord& r) { return r.come; });
  json["go"] = column([](const IntervalRecord& r) { return r.go; });
  json["closest"] =
      column([](const IntervalRecord& r) { return r.closest ? Json(*r.closest) : Json(nullptr); });
  json["undetermined_atoms"] = column([](const IntervalRecord& r) { return r.undetermined_atoms; });
  json["unmatched_atoms"] = column([](const IntervalRecord& r) { return r.unmatched_atoms; });
  json["candidates"] = column([](const IntervalRecord& r) { return r.candidates; });
  json["ms"] = column([](const IntervalRecord& r) { return r.ms; });
  return json;
}

Json between_json(const BetweenReport& between) {
  const IntervalRecord totals = between.totals();
  Json json = Json::object();
  json["intervals"] = between.intervals.size();
  json["followed"] = between.followed();
  json["hidden"] = totals.hidden;
  json["come"] = totals.come;
  json["go"] = totals.go;
  json["events"] = totals.events();
  json["undetermined_atoms"] = totals.undetermined_atoms;
  json["unmatched_atoms"] = totals.unmatched_atoms;
  const auto& closest = between.closest;
  const auto known = [&](const auto& value) { return closest ? Json(value) : Json(nullptr); };
  const BetweenReport::Closest none{}, &contact = closest ? *closest : none;
  json["closest"] = {{"distance", known(contact.closest)},
                     {"frame", known(contact.frame)},
                     {"next_frame", known(contact.next_frame)},
                     {"i", known(contact.i)},
                     {"j", known(contact.j)},
                     {"enters", known(contact.enters)},
                     {"leaves", known(contact.leaves)}};
  json["distance_histogram"] = between.distances;
  json["duration_histogram"] = between.durations;
  json["ms"] = totals.ms;
  json["per_interval"] = intervals_json(between);
  return json;
}

Json mismatch_json(const Mismatch& mismatch) {
  Json json{{"frame", mismatch.frame}, {"what", mismatch.what}};
  json["next_frame"] = mismatch.next_frame < 0 ? Json(nullptr) : Json(mismatch.next_frame);
  const bool is_pair = mismatch.what.ends_with("missing") || mismatch.what.ends_with("extra");
  json["atoms"] = is_pair ? Json{mismatch.atom_a, mismatch.atom_b} : Json::array();
  if (mismatch.what == "order") json["atoms"] = Json::array({mismatch.atom_a});
  json["distance"] = is_pair ? number_or_null(mismatch.distance) : Json(nullptr);
  json["detail"] = mismatch.detail;
  return json;
}

Json verify_json(const VerifyResult& verify) {
  Json json = Json::object();  // null would turn into an object, and be neither without memory
  json["mode"] = to_string(verify.mode);
  json["seed"] = verify.seed;
  json["frames"] = verify.frames;
  json["intervals"] = verify.intervals;
  json["rows"] = verify.rows;
  json["structure_checks"] = verify.structure_checks;
  json["first_mismatches"] = Json::array();
  for (const Mismatch& mismatch : verify.first) json["first_mismatches"].push_back(mismatch_json(mismatch));
  return json;
}

}  // namespace

std::string render_json(const ReplayReport& report) {
  const ReplayTotals totals = report.totals();
  Json json = input_json(report);
  json["pairs_per_frame"] = column(report, [](const FrameRecord& frame) { return frame.pairs; });
  json["pairs"] = {{"min", totals.pairs_min}, {"mean", totals.pairs_mean}, {"max", totals.pairs_max}};
  json["list_rebuilds"] = totals.list_rebuilds;
  json["refreshes"] = totals.refreshes;
  json["repairs"] = totals.repairs;
  json["rebuilds"] = totals.rebuilds;
  json["promotions"] = totals.promotions;
  json["demotions"] = totals.demotions;
  json["levels"] = report.levels.size();
  json["level_sizes"] = levels_json(report);
  json["degree_histogram"] = report.degree_histogram;
  json["list_hash"] = fmt::format("{:016x}", report.list_hash);
  json["timings_ms"] = {{"check_file", report.scan_ms},   {"read", totals.read_ms},
                        {"maintain", totals.maintain_ms}, {"list", totals.list_ms},
                        {"write", report.write_ms},       {"verify", report.verify_ms},
                        {"total", report.total_ms}};
  json["per_frame"] = per_frame_json(report);
  if (report.between) json["between"] = between_json(*report.between);
  json["mismatches"] = report.verify.mismatches;
  json["verify"] = verify_json(report.verify);
  constexpr int kIndent = 1;  // file names need not be UTF-8, JSON has to be
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dch::cli

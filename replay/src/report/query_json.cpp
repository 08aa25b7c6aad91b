// SPDX-License-Identifier: MIT
// report.json of `dchmd query`. docs/report-schema.md describes every key; change both together.
#include <nlohmann/json.hpp>

#include "report/query_report.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;

Json closest_json(const QueryReport& report) {
  const QueryFrame* const frame = report.closest();
  if (!frame) return {{"distance", nullptr}, {"i", nullptr}, {"j", nullptr}, {"frame", nullptr}};
  return {{"distance", frame->closest->distance},
          {"i", frame->closest->i},
          {"j", frame->closest->j},
          {"frame", frame->frame}};
}

Json nearest_json(const QueryReport& report) {
  Json ranks = Json::array();
  for (const LengthSpread& spread : report.nearest) {
    const bool any = spread.count() > 0;
    ranks.push_back({{"min", any ? Json(spread.least()) : Json(nullptr)},
                     {"mean", any ? Json(spread.mean()) : Json(nullptr)},
                     {"max", any ? Json(spread.most()) : Json(nullptr)}});
  }
  return ranks;
}

Json sizes_json(const std::map<std::int64_t, std::int64_t>& sizes) {
  Json json = Json::object();
  json["atoms"] = Json::array();
  json["number"] = Json::array();
  for (const auto& [size, number] : sizes) {
    json["atoms"].push_back(size);
    json["number"].push_back(number);
  }
  return json;
}

Json clusters_json(const QueryReport& report) {
  Json cutoffs = Json::array();
  for (std::size_t k = 0; k < report.cutoffs.size(); ++k) {
    Json json = Json::object();
    json["cutoff"] = report.cutoffs[k];
    json["sizes"] = sizes_json(report.sizes[k]);
    json["clusters"] = column(report, [k](const QueryFrame& f) { return f.clusters[k]; });
    json["largest"] = column(report, [k](const QueryFrame& f) { return f.largest[k]; });
    cutoffs.push_back(std::move(json));
  }
  return cutoffs;
}

Json curve_json(const QueryReport& report) {
  Json json = Json::object();
  json["cutoff"] = Json::array();
  json["clusters"] = Json::array();
  for (const ClusterCurve::Point& point : report.curve.points()) {
    json["cutoff"].push_back(point.cutoff);
    json["clusters"].push_back(point.clusters);
  }
  return json;
}

template <class Value>
Json closest_column(const QueryReport& report, Value value) {
  return column(report,
                [&](const QueryFrame& f) { return f.closest ? Json(value(*f.closest)) : Json(nullptr); });
}

Json per_frame_json(const QueryReport& report) {
  Json json = Json::object();  // null would turn into an object, and be neither without memory
  json["frame"] = column(report, [](const QueryFrame& f) { return f.frame; });
  json["step"] = column(report, [](const QueryFrame& f) { return f.step; });
  json["time"] =
      column(report, [](const QueryFrame& f) { return f.time ? number_or_null(*f.time) : Json(nullptr); });
  json["atoms"] = column(report, [](const QueryFrame& f) { return f.atoms; });
  json["closest_distance"] = closest_column(report, [](const AtomPair& pair) { return pair.distance; });
  json["closest_i"] = closest_column(report, [](const AtomPair& pair) { return pair.i; });
  json["closest_j"] = closest_column(report, [](const AtomPair& pair) { return pair.j; });
  json["read_ms"] = column(report, [](const QueryFrame& f) { return f.read_ms; });
  json["update_ms"] = column(report, [](const QueryFrame& f) { return f.update_ms; });
  json["nearest_ms"] = column(report, [](const QueryFrame& f) { return f.nearest_ms; });
  json["clusters_ms"] = column(report, [](const QueryFrame& f) { return f.clusters_ms; });
  return json;
}

}  // namespace

std::string render_json(const QueryReport& report) {
  Json json = begin_report(report, report.frames.size());
  json["nearest"] = nearest_json(report);
  json["closest"] = closest_json(report);
  if (!report.cutoffs.empty()) {
    json["clusters"] = clusters_json(report);
    json["curve"] = curve_json(report);
  }
  json["radius"] = report.radius;
  json["threads"] = report.threads;
  json["timings_ms"] = {
      {"check_file", report.scan_ms}, {"write", report.write_ms}, {"total", report.total_ms}};
  json["per_frame"] = per_frame_json(report);
  constexpr int kIndent = 1;  // file names need not be UTF-8, JSON has to be
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dch::cli

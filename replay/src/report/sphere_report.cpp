// SPDX-License-Identifier: MIT
#include "report/sphere_report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/number_text.hpp"
#include "report/report_rows.hpp"
#include "report/summary_json.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json block_values(const SphereReport& report, Value value) {
  Json array = Json::array();
  for (const SphereBlock& block : report.blocks) array.push_back(number_or_null(value(block)));
  return array;
}

Json blocks_json(const SphereReport& report) {
  Json json = Json::object();
  json["time"] = block_values(report, [](const SphereBlock& b) { return b.time; });
  json["collisions"] = Json::array();
  for (const SphereBlock& block : report.blocks) json["collisions"].push_back(block.collisions);
  json["pressure"] = block_values(report, [](const SphereBlock& b) { return b.pressure; });
  json["energy"] = block_values(report, [](const SphereBlock& b) { return b.energy; });
  json["seconds"] = block_values(report, [](const SphereBlock& b) { return b.seconds; });
  return json;
}

std::string sizes_text(const SphereReport& report) {
  const std::string least = readable(report.smallest_diameter);
  return report.is_monodisperse()
             ? fmt::format("diameter {}", least)
             : fmt::format("diameters {} to {}", least, readable(report.largest_diameter));
}

std::string start_text(const SphereReport& report) {
  if (report.growth_collisions == 0) return report.from;
  return fmt::format("{}, grown from the fraction {} in {}", report.from, readable(report.start_fraction),
                     counted(report.growth_collisions, "collision"));
}

std::string pressure_text(const SphereReport& report) {
  const double pressure = *report.pressure(), expected = report.expected_pressure;
  return fmt::format("{:.4f} of an ideal gas; {} {:.4f}, {:+.2f} % off", pressure,
                     report.is_monodisperse() ? "Carnahan-Starling" : "BMCSL", expected,
                     100 * (pressure / expected - 1));
}

}  // namespace

std::int64_t SphereReport::collisions() const {
  std::int64_t sum = 0;
  for (const SphereBlock& block : blocks) sum += block.collisions;
  return sum;
}

std::optional<double> SphereReport::pressure() const {
  if (blocks.size() < 2) return std::nullopt;
  double sum = 0;
  const std::size_t half = blocks.size() / 2;
  for (std::size_t k = half; k < blocks.size(); ++k)
    sum += blocks[k].pressure * (blocks[k].time - blocks[k - 1].time);
  return sum / (blocks.back().time - blocks[half - 1].time);
}

double SphereReport::microseconds_a_collision() const {
  double seconds = 0;
  for (const SphereBlock& block : blocks) seconds += block.seconds;
  return collisions() > 0 ? 1e6 * seconds / static_cast<double>(collisions()) : 0;
}

double SphereReport::energy_drift() const {
  return blocks.empty() || energy_at_start == 0 ? 0 : blocks.back().energy / energy_at_start - 1;
}

std::string render_json(const SphereReport& report) {
  Json json = begin_report();
  json["from"] = report.from;
  json["spheres"] = report.spheres;
  json["smallest_diameter"] = report.smallest_diameter;
  json["largest_diameter"] = report.largest_diameter;
  json["box_edge"] = report.edge;
  json["fraction"] = report.fraction;
  json["restitution"] = report.restitution;
  json["start_fraction"] = report.start_fraction;
  json["growth_collisions"] = report.growth_collisions;
  if (report.jam)
    json["jam"] = {{"growth", report.jam->rate},
                   {"fraction", report.jam->fraction},
                   {"pressure", number_or_null(report.jam->pressure)},
                   {"is_jammed", report.jam->is_jammed}};
  json["begin"] = report.begin;
  json["end"] = report.end;
  json["collisions"] = report.collisions();
  json["frames"] = report.frames;
  json["pressure"] = report.pressure() ? number_or_null(*report.pressure()) : Json(nullptr);
  json["expected_pressure"] = number_or_null(report.expected_pressure);
  json["energy_drift"] = report.energy_drift();
  json["least_gap"] = number_or_null(report.least_gap);
  json["microseconds_a_collision"] = report.microseconds_a_collision();
  json["blocks"] = blocks_json(report);
  constexpr int kIndent = 1;  // file names need not be UTF-8, JSON has to be
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string render_table(const SphereReport& report) {
  std::vector<Row> rows = {{"spheres", fmt::format("{} of {}", grouped(report.spheres), sizes_text(report))},
                           {"box", fmt::format("cube of {}", readable(report.edge))},
                           {"fraction", fmt::format("{:.6f}", report.fraction)},
                           {"start", start_text(report)}};
  if (report.jam)
    rows.push_back({"jammed", fmt::format("{} at {:.6f}, pressure {} of an ideal gas",
                                          report.jam->is_jammed ? "yes," : "no, full", report.jam->fraction,
                                          readable(report.jam->pressure))});
  rows.push_back({"time", fmt::format("{} to {}", readable(report.begin), readable(report.end))});
  rows.push_back({"collisions", grouped(report.collisions())});
  if (report.pressure() && report.collisions() > 0) rows.push_back({"pressure", pressure_text(report)});
  rows.push_back({"energy", fmt::format("{:+.1e} of what it was", report.energy_drift())});
  if (std::isfinite(report.least_gap))
    rows.push_back({"least gap", fmt::format("{:.1e} of the distance of a pair", report.least_gap)});
  rows.push_back({"us a collision", readable(report.microseconds_a_collision())});
  return render_rows(rows);
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "table_report.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>

namespace dch::bench {
namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

nlohmann::json json_of(const Measurement& m) {
  nlohmann::json json = {
      {"contender", m.contender},     {"ns_per_particle", m.ns}, {"update_ns_per_particle", m.update_ns},
      {"median", m.median()},         {"least", m.least()},      {"first", m.first_ns},
      {"bytes_per_particle", m.bytes}};
  if (!m.choice.empty()) json["choice"] = m.choice;
  if (m.keeps_structure)
    json["updates"] = {{"refreshes", m.stats.refreshes},
                       {"repairs", m.stats.repairs},
                       {"builds", m.stats.builds},
                       {"levels", m.stats.levels}};
  return json;
}

}  // namespace

double Measurement::median() const { return median_of(ns); }
double Measurement::least() const { return *std::min_element(ns.begin(), ns.end()); }

const Measurement* SceneResult::find(const std::string& contender) const {
  const auto found = std::find_if(measurements.begin(), measurements.end(),
                                  [&](const Measurement& m) { return m.contender == contender; });
  return found == measurements.end() ? nullptr : &*found;
}

const Measurement* SceneResult::best_grid() const {
  const Measurement* best = nullptr;
  for (const Measurement& m : measurements)
    if (!m.keeps_structure && m.choice.empty() && (!best || m.median() < best->median())) best = &m;
  return best;
}

double SceneResult::choice_over_best() const {
  const Measurement *chooser = find("auto"), *dch = find("dch"), *grid = find("grid");
  if (!chooser || !dch || !grid || chooser->choice.empty()) return 0;
  const bool by_grid = chooser->choice.starts_with("grid");
  return std::max(1.0, by_grid ? median_ratio(*grid, *dch) : median_ratio(*dch, *grid));
}

double median_ratio(const Measurement& a, const Measurement& b) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < a.ns.size(); ++k) ratios.push_back(a.ns[k] / b.ns[k]);
  return median_of(ratios);
}

void print_scene(const SceneResult& result) {
  fmt::print("\n{}: {} particles, {:.1f} pairs each, {} configurations ({})\n", result.scene,
             result.particles, result.pairs, result.lists, result.origin);
  fmt::print("  {:<24}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}  {}\n", "", "median", "least", "update", "first",
             "to grid", "bytes", "refreshed, repaired, built");
  const Measurement* grid = result.best_grid();
  for (const Measurement& m : result.measurements) {
    const std::string ratio = grid ? fmt::format("{:.2f}", median_ratio(m, *grid)) : "-";
    const std::string updates =
        m.keeps_structure ? fmt::format("{}, {}, {}", m.stats.refreshes, m.stats.repairs, m.stats.builds)
                          : "";
    fmt::print("  {:<24}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9}{:>9.0f}  {}\n", m.contender, m.median(),
               m.least(), median_of(m.update_ns), m.first_ns, ratio, m.bytes, updates);
  }
}

namespace {

/// `auto` over the fastest grid and over the better of the two engines that it chooses from, and its choice.
void print_choices(const std::vector<SceneResult>& results) {
  fmt::print("\n{:<14}{:>10}{:>10}{:>10}   {}\n", "scene", "to grid", "to best", "choice", "chosen at last");
  for (const SceneResult& result : results) {
    const Measurement *chooser = result.find("auto"), *dch = result.find("dch"), *grid = result.find("grid"),
                      *fastest = result.best_grid();
    if (!chooser || !dch || !grid) continue;
    fmt::print("{:<14}{:>10.2f}{:>10.2f}{:>10.2f}   {}\n", result.scene, median_ratio(*chooser, *fastest),
               std::max(median_ratio(*chooser, *dch), median_ratio(*chooser, *grid)),
               result.choice_over_best(), chooser->choice);
  }
  fmt::print(
      "auto over the fastest grid, and over the better of dch and grid; the engine that it took at last over "
      "the better one.\n");
}

}  // namespace

void print_summary(const std::vector<SceneResult>& results) {
  fmt::print("\n{:<14}{:>10}{:>12}{:>12}{:>8}   {}\n", "scene", "particles", "dch", "best grid", "ratio",
             "grid");
  for (const SceneResult& result : results) {
    const Measurement* ours = result.find("dch");
    const Measurement* grid = result.best_grid();
    fmt::print("{:<14}{:>10}{:>12}{:>12}{:>8}   {}\n", result.scene, result.particles,
               ours ? fmt::format("{:.1f}", ours->median()) : "-",
               grid ? fmt::format("{:.1f}", grid->median()) : "-",
               ours && grid ? fmt::format("{:.2f}", median_ratio(*ours, *grid)) : "-",
               grid ? grid->contender : "none fits");
  }
  fmt::print(
      "Times in ns for one particle and the lists of one configuration, medians of the repetitions.\n");
  print_choices(results);
}

void write_json(const std::string& path, const std::vector<SceneResult>& results) {
  nlohmann::json scenes = nlohmann::json::array();
  for (const SceneResult& result : results) {
    nlohmann::json measurements = nlohmann::json::array();
    for (const Measurement& m : result.measurements) measurements.push_back(json_of(m));
    scenes.push_back({{"scene", result.scene},
                      {"origin", result.origin},
                      {"particles", result.particles},
                      {"pairs_per_particle", result.pairs},
                      {"list_hash", fmt::format("{:016x}", result.list_hash)},
                      {"configurations", result.lists},
                      {"measurements", std::move(measurements)}});
  }
  const nlohmann::json report = {{"processor", processor()},
                                 {"instruction_set", name(instruction_set())},
                                 {"compiler", __VERSION__},
                                 {"scenes", std::move(scenes)}};
  std::ofstream file(path);
  file << report.dump(2) << '\n';
  if (!file.flush()) throw Error(path + ": cannot be written");
}

}  // namespace dch::bench

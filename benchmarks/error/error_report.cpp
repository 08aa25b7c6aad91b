// SPDX-License-Identifier: MIT
#include "error_report.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>

#include "rebuild_rules.hpp"

namespace dch::bench {
namespace {

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

const char* name_of(ForcePrecision precision) {
  return precision == ForcePrecision::double_precision ? "double" : "mixed";
}

nlohmann::json json_of(const TrialResult& result) {
  const TrialErrors& errors = result.errors;
  return {{"rule", title_of_rule(result.trial.rule)},
          {"skin", result.trial.skin},
          {"precision", name_of(result.trial.precision)},
          {"ns_per_atom_and_step", result.ns},
          {"checks", errors.checks},
          {"pairs", errors.pairs},
          {"missed", errors.missed},
          {"missed_by_list", errors.missed_by_list},
          {"force_error", errors.force_error},
          {"largest_force_error", errors.largest_force_error},
          {"energy_drift", errors.energy_drift},
          {"energy_noise", errors.energy_noise},
          {"rebuilds", errors.rebuilds}};
}

nlohmann::json json_of(const SwitchCost& cost) {
  return {{"what", cost.what},   {"ns_per_atom", cost.ns}, {"first", cost.first_ns}, {"bytes", cost.bytes},
          {"edges", cost.edges}, {"levels", cost.levels},  {"listed", cost.listed},  {"margin", cost.margin}};
}

}  // namespace

void print(const ErrorReport& report) {
  fmt::print("{} atoms, {} steps of {}, compared every {} steps\n", report.atoms, report.length.steps,
             report.length.time_step, report.length.check_every);
  fmt::print("  {:<16}{:>6} {:<7}{:>9}{:>10}{:>10}{:>9}{:>12}{:>12}{:>12}\n", "rule", "skin", "forces",
             "rebuilds", "missed", "by list", "ns", "force error", "drift", "noise");
  for (const TrialResult& result : report.trials) {
    const TrialErrors& errors = result.errors;
    fmt::print("  {:<16}{:>6} {:<7}{:>9}{:>10}{:>10}{:>9.1f}{:>12.2e}{:>12.2e}{:>12.2e}\n",
               title_of_rule(result.trial.rule), result.trial.skin, name_of(result.trial.precision),
               errors.rebuilds, errors.missed, errors.missed_by_list, median_of(result.ns),
               errors.force_error, errors.energy_drift, errors.energy_noise);
  }
  if (report.switches.empty()) return;
  fmt::print("\n  {:<24}{:>9}{:>9}{:>9}{:>9}{:>8}{:>9}\n", "structure", "ns", "first", "bytes", "edges",
             "levels", "listed");
  for (const SwitchCost& cost : report.switches)
    fmt::print("  {:<24}{:>9.1f}{:>9.1f}{:>9.0f}{:>9.2f}{:>8}{:>9.1f}\n", cost.what, median_of(cost.ns),
               cost.first_ns, cost.bytes, cost.edges, cost.levels, cost.listed);
}

void write_json(const std::string& path, const ErrorReport& report) {
  nlohmann::json trials = nlohmann::json::array(), switches = nlohmann::json::array();
  for (const TrialResult& result : report.trials) trials.push_back(json_of(result));
  for (const SwitchCost& cost : report.switches) switches.push_back(json_of(cost));
  const nlohmann::json json = {{"instruction_set", name(instruction_set())},
                               {"compiler", __VERSION__},
                               {"atoms", report.atoms},
                               {"seed", report.seed},
                               {"list_hash", fmt::format("{:016x}", report.list_hash)},
                               {"steps", report.length.steps},
                               {"check_every", report.length.check_every},
                               {"time_step", report.length.time_step},
                               {"trials", std::move(trials)},
                               {"switches_skin", report.switches_skin},
                               {"switches", std::move(switches)}};
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  if (!file.flush()) throw Error(path + ": cannot be written");
}

}  // namespace dch::bench

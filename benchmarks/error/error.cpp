// SPDX-License-Identifier: MIT
//
// Speed against error: the Lennard-Jones melt run with several skins and rebuild rules, each compared with
// the pairs within the cutoff that a cell list finds. See benchmarks/README.md.
#include <algorithm>
#include <fmt/format.h>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "affinity.hpp"
#include "error_report.hpp"
#include "pair_check.hpp"
#include "program.hpp"
#include "rebuild_rules.hpp"

namespace dch::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kSwitchesSkin = 0.3;

struct Options {
  int cells = 20, melt_steps = 500, configurations = 20, repetitions = 5, processor = 0;
  std::vector<double> skins = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  std::vector<std::string> rules = {"certified", "every:10", "every:20", "every:40", "openmm"};
  TrialLength length;
  bool require_complete = false;
  std::string json;
};

/// Every rule with every skin in double; the certified one in single precision too.
std::vector<TrialResult> planned(const Options& options) {
  std::vector<TrialResult> trials;
  for (const double skin : options.skins)
    for (const std::string& rule : options.rules) {
      const bool certified = make_rebuild_rule(rule, kMeltCutoff, skin)->is_certified();
      trials.push_back({{rule, skin, ForcePrecision::double_precision}, {}, {}});
      if (certified) trials.push_back({{rule, skin, ForcePrecision::mixed}, {}, {}});
    }
  return trials;
}

/// The counter of missed pairs has to see those that are not there: pairs within the cutoff beyond a shorter
/// one.
void check_counter(const Melt& melt) {
  const auto search = make_cell_search(kMeltCutoff);
  search->update(melt.positions, melt.box);
  ListParams params;
  params.cutoffs = TypeCutoffs(kMeltCutoff);
  const NeighborList all = search->list(params);
  params.cutoffs = TypeCutoffs(0.9 * kMeltCutoff);
  const NeighborList near = search->list(params);
  const std::int64_t missed = HeldPairs(near).missing_of(all);
  if (missed != all.pairs() - near.pairs() || missed == 0 || HeldPairs(all).missing_of(all) != 0)
    throw Error(
        fmt::format("the counter of missed pairs has found {} of {}", missed, all.pairs() - near.pairs()));
}

/// Whether all rules that have to be complete are; says on stderr which are not.
bool are_complete(const Options& options, const std::vector<TrialResult>& trials) {
  bool complete = true;
  for (const TrialResult& result : trials) {
    const bool must = options.require_complete ||
                      make_rebuild_rule(result.trial.rule, kMeltCutoff, result.trial.skin)->is_certified();
    const std::int64_t missed = std::max(result.errors.missed, result.errors.missed_by_list);
    if (!must || missed == 0) continue;
    complete = false;
    fmt::print(stderr, "dch_bench_error: the rule '{}' with skin {} misses {} pairs\n",
               title_of_rule(result.trial.rule), result.trial.skin, missed);
  }
  return complete;
}

int run(const Options& options) {
  pin_to(options.processor);
  const Melt start = melted(make_crystal(options.cells, kSeed), options.melt_steps, options.length.time_step);
  check_counter(start);
  ErrorReport report;
  report.atoms = start.positions.size();
  report.seed = kSeed;
  report.list_hash = sum_of(truth_of(start).pairs).hash;
  report.length = options.length;
  report.switches_skin = kSwitchesSkin;
  report.trials = planned(options);
  for (TrialResult& result : report.trials) result.errors = errors_of(start, result.trial, options.length);
  if (!are_complete(options, report.trials)) return kWrong;
  for (int repetition = 0; repetition < options.repetitions; ++repetition)
    for (TrialResult& result : report.trials)
      result.ns.push_back(time_of(start, result.trial, options.length));
  if (options.configurations > 0)
    report.switches = costs_of_switches(start, kSwitchesSkin, options.configurations, options.repetitions);
  print(report);
  if (!options.json.empty()) write_json(options.json, report);
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Speed against error: skins and rebuild rules in the Lennard-Jones melt", "dch_bench_error");
  Options options;
  app.add_option("--cells", options.cells, "Cubic cells of four atoms along each axis, 5 or more")
      ->check(CLI::Range(5, 100));
  app.add_option("--steps", options.length.steps, "Steps of each trial")->check(CLI::PositiveNumber);
  app.add_option("--melt-steps", options.melt_steps, "Steps before the trials")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--check-every", options.length.check_every, "Steps between comparisons")
      ->check(CLI::PositiveNumber);
  app.add_option("--time-step", options.length.time_step, "Time step")->check(CLI::PositiveNumber);
  app.add_option("--skins", options.skins, "Skins")->delimiter(',')->check(CLI::PositiveNumber);
  app.add_option("--rules", options.rules, "Rebuild rules: certified, every:N, openmm")->delimiter(',');
  app.add_flag("--require-complete", options.require_complete, "End with status 1 if any rule misses a pair");
  app.add_option("--configurations", options.configurations,
                 "Configurations for the cost of other structures; 0: do not measure it")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--repetitions", options.repetitions, "Repetitions, of which medians are taken")
      ->check(CLI::PositiveNumber);
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  app.add_option("--json", options.json, "File for all measurements");
  return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

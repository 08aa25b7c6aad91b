// SPDX-License-Identifier: MIT
//
// How long kept lists live by either rule of Expiry, and what a particle and step costs: upkeep of the
// structure, lists, and the tests of every step. Frames have to be one step of dynamics apart.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <dch/engines/verlet_list.hpp>

#include "affinity.hpp"
#include "program.hpp"
#include "scene.hpp"
#include "stopwatch.hpp"

namespace dch::bench {
namespace {

struct Options {
  std::vector<std::string> scenes{"melt32k:0.2", "melt32k:0.3", "melt32k:0.4", "chain32k:0.4"};
  std::vector<std::string> engines{"dch", "grid"};
  SceneOptions scene;
  std::string json;
  int frames = 200, repetitions = 3, processor = 0;
};

/// A scene and the lists that are kept of it.
struct Kept {
  std::unique_ptr<Scene> scene;
  ListParams params;
  int frames;
};

Kept kept_of(const std::string& word, const Options& options) {
  const std::size_t colon = word.rfind(':');
  if (colon == std::string::npos)
    throw CLI::ValidationError("--scenes", word + " is not SCENE:SKIN, as melt32k:0.3");
  SceneOptions from = options.scene;
  from.most_frames = static_cast<std::size_t>(options.frames) + 1;
  const std::string name = word.substr(0, colon);
  Kept kept{make_scene(name, from), {}, options.frames};
  kept.params.cutoffs = TypeCutoffs(name == "chain32k" ? 1.12 : 2.5);
  kept.params.skin = std::stod(word.substr(colon + 1));
  kept.params.order = RowOrder::unsorted;
  if (!kept.scene->exclusions.empty()) kept.params.exclusions = &kept.scene->exclusions;
  // Without a trajectory particles move at random by what ten steps of dynamics move them.
  if (auto* const random = dynamic_cast<RandomScene*>(kept.scene.get())) random->step_length *= 0.1;
  return kept;
}

std::unique_ptr<PairSearch> engine_of(const std::string& name, double radius) {
  HierarchyParams hierarchy;
  hierarchy.radius = radius;
  return make_search(name, hierarchy);
}

/// Pairs of a list that are within the cutoff.
std::int64_t pairs_within(const NeighborList& list, const Scene& scene, double cutoff) {
  std::int64_t count = 0;
  for (std::size_t r = 0; r < list.size(); ++r)
    for (const std::int32_t j : list.row(r))
      count += scene.box.distance2(scene.positions[list.particle[r]], scene.positions[j]) <= cutoff * cutoff;
  return count;
}

/// Reads a list as forces do, so that it is in the caches and other things are not.
std::int64_t read_once(const NeighborList& list) {
  std::int64_t sum = 0;
  for (std::size_t r = 0; r < list.size(); ++r)
    for (const std::int32_t j : list.row(r)) sum += j;
  return sum;
}

/// Follows the scene by exact expiry, and compares the pairs within the cutoff with those of a list that is
/// made for them.
void check(Kept& kept, const std::string& engine) {
  ListParams bare = kept.params;
  bare.skin = 0;
  const double cutoff = bare.cutoffs.largest();
  const auto fresh = engine_of("cell", cutoff);
  VerletList list(engine_of(engine, kept.params.list_radius()), kept.params, Expiry::exact);
  kept.scene->restart();
  bare.order = RowOrder::by_index;
  for (int step = 0; step <= kept.frames; ++step) {
    list.update(kept.scene->positions, kept.scene->box);
    fresh->update(kept.scene->positions, kept.scene->box);
    const std::int64_t expected = fresh->list(bare).pairs();
    const std::int64_t found = pairs_within(list.list(), *kept.scene, cutoff);
    if (found != expected)
      throw WrongAnswer(
          fmt::format("{} with skin {}, {}, step {}: {} pairs within the cutoff, the list has {}",
                      kept.scene->name, kept.params.skin, engine, step, expected, found));
    if (!kept.scene->step()) break;
  }
}

/// What a rule costs and gives, a particle and step in nanoseconds.
struct Cost {
  double total = 0;  ///< all of update(): upkeep of the structure, lists and tests
  double test = 0;   ///< of it, in a step that keeps the list
  double steps = 0;  ///< that a list lives
  ExpiryStats expiry;
  std::int64_t rebuilds = 0;
};

Cost cost_of(Kept& kept, const std::string& engine, Expiry rule) {
  VerletList list(engine_of(engine, kept.params.list_radius()), kept.params, rule);
  Scene& scene = *kept.scene;
  scene.restart();
  list.update(scene.positions, scene.box);
  double seconds = 0, keeping = 0;
  std::int64_t sum = 0;
  int steps = 0, kept_steps = 0;
  for (; steps < kept.frames && scene.step(); ++steps) {
    sum += read_once(list.list());
    bool is_new = false;
    const double took = seconds_of([&] { is_new = list.update(scene.positions, scene.box); });
    seconds += took;
    keeping += is_new ? 0 : took;
    kept_steps += !is_new;
  }
  const std::int64_t lists = list.rebuilds() - 1;
  if (sum < 0 || lists == 0) throw Error(scene.name + ": no list has gone stale; more frames are needed");
  const double each = 1e9 / static_cast<double>(scene.positions.size());
  return {each * seconds / steps, each * keeping / std::max(1, kept_steps),
          static_cast<double>(steps) / static_cast<double>(lists), list.expiry(), lists};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The rules in turns; of their times the medians.
std::array<Cost, 2> costs_of(Kept& kept, const std::string& engine, int repetitions) {
  std::array<Cost, 2> costs;
  std::array<std::vector<double>, 2> total, test;
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (const std::size_t rule : {0u, 1u}) {
      costs[rule] = cost_of(kept, engine, rule == 0 ? Expiry::half_skin : Expiry::exact);
      total[rule].push_back(costs[rule].total);
      test[rule].push_back(costs[rule].test);
    }
  for (const std::size_t rule : {0u, 1u}) {
    costs[rule].total = median(total[rule]);
    costs[rule].test = median(test[rule]);
  }
  return costs;
}

int run(const Options& options) {
  pin_to(options.processor);
  nlohmann::json rows = nlohmann::json::array();
  fmt::print(
      "steps a list lives; ns a particle and step: all of it, and a test that keeps the list; queries a "
      "particle and list; lists given up for a pair and because too many were fast\n\n"
      "| Scene | Skin | Engine | Steps, half skin | Steps, exact | Ratio | All, half skin | Test | All, "
      "exact | "
      "Test | Ratio | Queries | For a pair | Too many "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& word : options.scenes) {
    Kept kept = kept_of(word, options);
    const auto particles = static_cast<double>(kept.scene->positions.size());
    for (const std::string& engine : options.engines) {
      check(kept, engine);
      const auto [half, exact] = costs_of(kept, engine, options.repetitions);
      const double queries = static_cast<double>(exact.expiry.queries) / particles /
                             std::max<double>(1, static_cast<double>(exact.rebuilds));
      rows.push_back({{"scene", kept.scene->name},
                      {"origin", kept.scene->origin},
                      {"skin", kept.params.skin},
                      {"engine", engine},
                      {"particles", particles},
                      {"half_skin_steps", half.steps},
                      {"exact_steps", exact.steps},
                      {"half_skin_ns", half.total},
                      {"half_skin_test_ns", half.test},
                      {"exact_ns", exact.total},
                      {"exact_test_ns", exact.test},
                      {"queries", queries},
                      {"missing", exact.expiry.missing},
                      {"too_many", exact.expiry.too_many}});
      fmt::print(
          "| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.3f} | "
          "{} | {} |\n",
          kept.scene->name, kept.params.skin, engine, half.steps, exact.steps, exact.steps / half.steps,
          half.total, half.test, exact.total, exact.test, exact.total / half.total, queries,
          exact.expiry.missing, exact.expiry.too_many);
      std::fflush(stdout);
    }
  }
  if (options.json.empty()) return kOk;
  std::ofstream file(options.json);
  file << nlohmann::json{{"expiry", rows}}.dump(1) << '\n';
  if (!file.flush()) throw Error("cannot write " + options.json);
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Steps that kept lists live by either rule of expiry, and their cost", "dch_bench_expiry");
  Options options;
  app.add_option("--scenes", options.scenes, "Scenes and skins, as melt32k:0.3")->delimiter(',');
  app.add_option("--engines", options.engines, "Engines to keep lists with")->delimiter(',');
  app.add_option("--trajectories", options.scene.trajectories,
                 "Folder of make_trajectories --every 1, one step from a frame to the next");
  app.add_option("--frames", options.frames, "Steps to follow")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Turns of each rule, of which the median counts")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "File for all rows");
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  app.add_option("--scale", options.scene.scale,
                 "Particles of scenes without a trajectory, relative to the usual number")
      ->check(CLI::PositiveNumber);
  return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

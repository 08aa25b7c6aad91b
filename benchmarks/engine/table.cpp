// SPDX-License-Identifier: MIT
//
// Neighbor lists of the hierarchy against those of grids made with the same kernels, scene by scene: see
// benchmarks/README.md. All lists are compared before anything is timed; then all contenders take turns at
// each configuration.
#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include <dch/base/error.hpp>

#include "affinity.hpp"
#include "list_check.hpp"
#include "program.hpp"
#include "stopwatch.hpp"
#include "table_report.hpp"
#include "write_scene.hpp"

namespace dch::bench {
namespace {

struct Options {
  std::vector<std::string> scenes = scene_names();
  SceneOptions scene;
  int lists = 100, repetitions = 5, threads = 1, processor = 0;
  std::string json, only, write;
};

/// Large scenes get fewer configurations, so that each repetition makes lists for about as many particles.
int configurations(const Scene& scene, const Options& options) {
  constexpr double kParticles = 32000;
  constexpr int kMinLists = 20;  // so that there are repairs among them
  const double fitting = options.lists * kParticles / static_cast<double>(scene.positions.size());
  return std::clamp(static_cast<int>(fitting), std::min(options.lists, kMinLists), options.lists);
}

/// One repetition: all contenders take turns, each configuration in another order, so that none always finds
/// the positions in the cache; slow ones not at every configuration. Returns the number of configurations
/// after the first.
int time_once(Scene& scene, Contenders& contenders, int lists, Clock clock,
              std::vector<Measurement>& measurements) {
  const std::size_t count = contenders.size();
  const double per_particle = 1e9 / static_cast<double>(scene.positions.size());
  std::vector<std::vector<NeighborList>> made(
      count, std::vector<NeighborList>(std::max<std::size_t>(1, scene.list_radii.size())));
  std::vector<double> seconds(count, 0), updating(count, 0);
  scene.restart();
  for (std::size_t c = 0; c < count; ++c) {
    contenders[c]->reset();
    const double first = per_particle * seconds_of([&] { contenders[c]->make_lists(scene, made[c]); }, clock);
    measurements[c].first_ns = std::min(measurements[c].first_ns, first);
  }
  std::vector<int> times(count, 0);
  int done = 0;
  for (; done < lists && scene.step(); ++done)
    for (std::size_t turn = 0; turn < count; ++turn) {
      const std::size_t c = (turn + static_cast<std::size_t>(done)) % count;
      if (done % contenders[c]->every() != 0) continue;
      ++times[c];
      const double update = seconds_of([&] { contenders[c]->update(scene); }, clock);
      updating[c] += update;
      seconds[c] += update + seconds_of([&] { contenders[c]->list(scene, made[c]); }, clock);
    }
  for (std::size_t c = 0; c < count; ++c) {
    measurements[c].ns.push_back(per_particle * seconds[c] / times[c]);
    measurements[c].update_ns.push_back(per_particle * updating[c] / times[c]);
  }
  return done;
}

SceneResult measure(const std::string& name, const Options& options, Executor* executor) {
  SceneOptions scene_options = options.scene;
  scene_options.most_frames = static_cast<std::size_t>(options.lists) + 1;
  const std::unique_ptr<Scene> scene = make_scene(name, scene_options);
  Contenders contenders = make_contenders(*scene, executor, options.only);
  if (contenders.empty()) throw Error(name + ": there is no contender '" + options.only + "'");
  SceneResult result;
  result.scene = name;
  result.origin = scene->origin;
  result.particles = scene->positions.size();
  const int lists = configurations(*scene, options);
  const CheckedLists checked = check_lists(*scene, contenders, {.last = lists});
  result.pairs = static_cast<double>(checked.last_pairs) / static_cast<double>(result.particles);
  result.list_hash = checked.last_hash;
  for (const auto& contender : contenders) {
    Measurement m;
    m.contender = contender->name();
    m.first_ns = std::numeric_limits<double>::infinity();
    result.measurements.push_back(std::move(m));
  }
  for (int k = 0; k < options.repetitions; ++k)
    result.lists =
        time_once(*scene, contenders, lists, executor ? Clock::wall : Clock::thread, result.measurements);
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    Measurement& m = result.measurements[c];
    m.bytes = static_cast<double>(contenders[c]->memory_bytes()) / static_cast<double>(result.particles);
    m.choice = contenders[c]->choice();
    m.keeps_structure = contenders[c]->stats() != nullptr;
    if (m.keeps_structure) m.stats = *contenders[c]->stats();
  }
  return result;
}

int run(const Options& options) {
  if (!options.write.empty()) {
    SceneOptions first = options.scene;
    first.most_frames = 1;
    for (const std::string& name : options.scenes) write_scene(*make_scene(name, first), options.write);
    return kOk;
  }
  std::unique_ptr<Executor> executor;
  if (options.threads > 1) {
    executor = make_thread_pool(options.threads);
  } else {
    pin_to(options.processor);
  }
  std::vector<SceneResult> results;
  for (const std::string& name : options.scenes) {
    results.push_back(measure(name, options, executor.get()));
    print_scene(results.back());
    std::fflush(stdout);
  }
  print_summary(results);
  if (!options.json.empty()) write_json(options.json, results);
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Neighbor lists of the hierarchy and of grids, compared and timed", "dch_bench_table");
  Options options;
  app.add_option("--scenes", options.scenes, "Scenes to measure; all if left out")->delimiter(',');
  app.add_option("--trajectories", options.scene.trajectories, "Folder filled by make_trajectories");
  app.add_option("--lists", options.lists, "Most configurations of a repetition")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Repetitions, of which medians are taken")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads,
                 "Measure the hierarchy on this many threads too; then no processor is pinned")
      ->check(CLI::PositiveNumber);
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  app.add_option("--scale", options.scene.scale,
                 "Particles of artificial scenes, relative to the usual number")
      ->check(CLI::PositiveNumber);
  app.add_option("--only", options.only, "Measure the contender of this name alone");
  app.add_option("--write", options.write,
                 "Folder for the first configurations, as other programs may read them; "
                 "then nothing is measured");
  app.add_option("--json", options.json, "File for all measurements");
  return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

// SPDX-License-Identifier: MIT
//
// OpenMM's CpuNeighborList, one thread, and the hierarchy on the same configurations, taking turns.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fmt/format.h>

#include "affinity.hpp"
#include "contender.hpp"
#include "openmm_lists.hpp"
#include "stopwatch.hpp"
#include "table_report.hpp"

namespace dch::bench {
namespace {

struct Options {
  std::string scene = "melt32k";
  SceneOptions files;
  int lists = 20, repetitions = 5, processor = 0;
};

/// The list is in float, so pairs at the very radius may differ; no others.
void check(const Scene& scene, OpenMmLists& lists) {
  lists.take(scene);
  lists.make();
  const PairSum expected = expected_pairs(scene, 0), found = lists.pairs_within(scene);
  const std::int64_t differing = std::abs(expected.pairs - found.pairs);
  constexpr double kAtTheRadius = 1e-5;  // of all pairs
  if (static_cast<double>(differing) > kAtTheRadius * static_cast<double>(expected.pairs))
    throw Error(fmt::format("{}: OpenMM's list has {} pairs within the radius, expected {}", scene.name,
                            found.pairs, expected.pairs));
  const double per_particle = 1 / static_cast<double>(scene.positions.size());
  fmt::print(
      "{}: {} pairs within the radius, {} of them in OpenMM's list, which holds {:.1f} pairs for each of {} "
      "particles\n",
      scene.name, expected.pairs, found.pairs, static_cast<double>(lists.pairs_held()) * per_particle,
      scene.positions.size());
}

void time_once(Scene& scene, OpenMmLists& theirs, Contender& ours, int lists, Measurement& their_time,
               Measurement& our_time) {
  std::vector<NeighborList> made(scene.list_radii.size());
  double their_seconds = 0, our_seconds = 0;
  scene.restart();
  ours.reset();
  ours.make_lists(scene, made);
  int done = 0;
  for (; done < lists && scene.step(); ++done) {
    theirs.take(scene);
    their_seconds += seconds_of([&] { theirs.make(); }, Clock::process);
    our_seconds += seconds_of([&] { ours.make_lists(scene, made); }, Clock::process);
  }
  const double per_particle = 1e9 / (done * static_cast<double>(scene.positions.size()));
  their_time.ns.push_back(their_seconds * per_particle);
  our_time.ns.push_back(our_seconds * per_particle);
}

int run(Options options) {
  pin_to(options.processor);
  options.files.most_frames = static_cast<std::size_t>(options.lists) + 1;
  const std::unique_ptr<Scene> scene = make_scene(options.scene, options.files);
  if (scene->list_radii.size() != 1)
    throw Error(options.scene + ": choose a scene with a single list radius");
  OpenMmLists theirs(*scene);
  DchContender ours("dch", *scene, {});
  check(*scene, theirs);
  Measurement their_time, our_time;
  for (int k = 0; k < options.repetitions; ++k)
    time_once(*scene, theirs, ours, options.lists, their_time, our_time);
  fmt::print("{}: OpenMM CpuNeighborList: median {:.1f}, least {:.1f} ns for one particle and list\n",
             options.scene, their_time.median(), their_time.least());
  fmt::print("{}: dch: median {:.1f}, least {:.1f}; time of dch over theirs {:.3f}\n", options.scene,
             our_time.median(), our_time.least(), median_ratio(our_time, their_time));
  return 0;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("OpenMM's CpuNeighborList and the hierarchy on the same configurations");
  Options options;
  app.add_option("scene", options.scene, "A scene with one list radius and a periodic box. Default melt32k");
  app.add_option("--trajectories", options.files.trajectories, "Folder filled by make_trajectories");
  app.add_option("--lists", options.lists, "Configurations of a repetition")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Repetitions, of which medians are taken")
      ->check(CLI::PositiveNumber);
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return run(options);
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) {
  try {
    return dch::bench::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "dch_bench_openmm: {}\n", error.what());
    return 3;
  }
}

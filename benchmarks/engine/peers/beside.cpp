// SPDX-License-Identifier: MIT
//
// The lists of a library, one thread, and the hierarchy on the same configurations, taking turns.
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "affinity.hpp"
#include "contender.hpp"
#include "list_check.hpp"
#include "peer_lists.hpp"
#include "program.hpp"
#include "stopwatch.hpp"
#include "table_report.hpp"

namespace dch::bench {
namespace {

struct Options {
  std::string scene = "melt32k";
  SceneOptions files;
  int lists = 20, repetitions = 5, processor = 0;
  std::string json;
};

/// In float pairs at the very radius may differ; no others.
void check(const Scene& scene, PeerLists& lists) {
  lists.take(scene);
  lists.make();
  const PairSum expected = expected_pairs(scene, 0), found = lists.pairs_within(scene);
  const std::int64_t differing = std::abs(expected.pairs - found.pairs);
  constexpr double kAtTheRadius = 1e-5;  // of all pairs
  const double allowed = lists.in_double() ? 0 : kAtTheRadius * static_cast<double>(expected.pairs);
  if (static_cast<double>(differing) > allowed || (lists.in_double() && expected != found))
    throw WrongAnswer(fmt::format("{}: {} has {} pairs within the radius, expected {}", scene.name,
                                  lists.name(), found.pairs, expected.pairs));
  const double per_particle = 1 / static_cast<double>(scene.positions.size());
  fmt::print(
      "{}: {} pairs within the radius, {} of them in the list of {}, which holds {:.1f} pairs for each of {} "
      "particles\n",
      scene.name, expected.pairs, found.pairs, lists.name(),
      static_cast<double>(lists.pairs_held()) * per_particle, scene.positions.size());
}

/// What takes turns: the lists of the peer, perhaps others, and last those of the hierarchy.
struct Turns {
  std::vector<std::unique_ptr<PeerLists>> lists;
  std::vector<Measurement> times;  ///< by lists, then the hierarchy's
};

void time_once(Scene& scene, Turns& turns, Contender& ours, int lists) {
  std::vector<NeighborList> made(scene.list_radii.size());
  std::vector<double> seconds(turns.times.size(), 0.0);
  scene.restart();
  ours.reset();
  ours.make_lists(scene, made);
  for (const auto& other : turns.lists) {
    other->forget();
    other->take(scene);
    other->make();
  }
  int done = 0;
  for (; done < lists && scene.step(); ++done) {
    for (std::size_t k = 0; k < turns.lists.size(); ++k) {
      turns.lists[k]->take(scene);
      seconds[k] += seconds_of([&] { turns.lists[k]->make(); }, Clock::process);
    }
    seconds.back() += seconds_of([&] { ours.make_lists(scene, made); }, Clock::process);
  }
  const double per_particle = 1e9 / (done * static_cast<double>(scene.positions.size()));
  for (std::size_t k = 0; k < seconds.size(); ++k) turns.times[k].ns.push_back(seconds[k] * per_particle);
}

void write_json(const Options& options, const Turns& turns) {
  nlohmann::json report = {{"scene", options.scene},
                           {"peer", turns.lists.front()->name()},
                           {"theirs", turns.times.front().ns},
                           {"ours", turns.times.back().ns}};
  if (turns.lists.size() > 1)
    report["more"] = {{"name", turns.lists.back()->name()}, {"ns", turns.times[1].ns}};
  std::ofstream file(options.json);
  file << report.dump(1) << '\n';
  if (!file.flush()) throw Error(options.json + ": cannot be written");
}

void print(const Options& options, const Turns& turns) {
  const Measurement& theirs = turns.times.front();
  for (std::size_t k = 0; k < turns.times.size(); ++k) {
    const std::string name = k < turns.lists.size() ? turns.lists[k]->name() : "dch";
    fmt::print("{}: {}: median {:.1f}, least {:.1f} ns for one particle and list", options.scene, name,
               turns.times[k].median(), turns.times[k].least());
    if (k > 0) fmt::print("; over theirs {:.3f}", median_ratio(turns.times[k], theirs));
    fmt::print("\n");
  }
}

int run(Options options, const PeerMaker& make_peer, const PeerMaker& make_more) {
  pin_to(options.processor);
  options.files.most_frames = static_cast<std::size_t>(options.lists) + 1;
  const std::unique_ptr<Scene> scene = make_scene(options.scene, options.files);
  const bool is_cuboid = scene->box.kind() == Box::Kind::orthorhombic && scene->box.origin() == Vec3{} &&
                         scene->box.periodic(0) && scene->box.periodic(1) && scene->box.periodic(2);
  if (scene->list_radii.size() != 1 || !is_cuboid)
    throw Error(options.scene + ": choose a scene with a single list radius and a periodic cuboid for a box");
  Turns turns;
  turns.lists.push_back(make_peer(*scene));
  if (make_more) turns.lists.push_back(make_more(*scene));
  turns.times.resize(turns.lists.size() + 1);
  DchContender ours("dch", *scene, {});
  for (const auto& lists : turns.lists) check(*scene, *lists);
  for (int k = 0; k < options.repetitions; ++k) time_once(*scene, turns, ours, options.lists);
  print(options, turns);
  if (!options.json.empty()) write_json(options, turns);
  return kOk;
}

}  // namespace

int run_beside(int argc, char** argv, const PeerMaker& make_peer, const PeerMaker& make_more) {
  CLI::App app("Lists of another library and of the hierarchy on the same configurations");
  Options options;
  app.add_option("scene", options.scene, "A scene with one list radius and a periodic box. Default melt32k");
  app.add_option("--trajectories", options.files.trajectories, "Folder filled by make_trajectories");
  app.add_option("--lists", options.lists, "Configurations of a repetition")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Repetitions, of which medians are taken")
      ->check(CLI::PositiveNumber);
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  app.add_option("--scale", options.files.scale,
                 "Particles of artificial scenes, relative to the usual number")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "File for the times of all repetitions");
  return run_program(app, argc, argv, [&] { return run(options, make_peer, make_more); });
}

}  // namespace dch::bench

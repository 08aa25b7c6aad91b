// SPDX-License-Identifier: MIT
//
// By what the weights of lib/src/hierarchy/maintenance_cost.hpp were found: the same displacements repaired
// and built anew, scene by scene and step by step, beside what the automatic policy does.
#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include <dch/hierarchy/hierarchy.hpp>

#include "affinity.hpp"
#include "program.hpp"
#include "scene.hpp"
#include "stopwatch.hpp"

namespace dch::bench {
namespace {

struct Options {
  std::vector<std::string> scenes{"melt4k",      "melt32k",  "melt256k", "hotgas",
                                  "droplet+gas", "clusters", "shear",    "swollen"};
  std::vector<double> steps{0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1, 3};
  SceneOptions scene;
  std::string json;
  int updates = 6, repetitions = 3, processor = 0;
};

/// What it takes to bring a structure up to date, a particle and update.
struct Cost {
  double ns = std::numeric_limits<double>::infinity();
  double orphans = 0;              ///< nodes that got another parent
  double repairs = 0, builds = 0;  ///< an update; neither where that was put off
};

enum class Way { repair, build, automatic };

Hierarchy hierarchy_for(const Scene& scene, Way way) {
  HierarchyParams params;
  params.radius = scene.list_radii.back();
  Hierarchy hierarchy(params);
  hierarchy.build(scene.positions, scene.box);
  // A free id keeps update() from building anew, whatever it would choose.
  if (way == Way::repair) hierarchy.remove(hierarchy.insert(scene.positions.front()));
  return hierarchy;
}

/// Brings the hierarchy to the scene's present positions; none but the automatic way puts repairs off.
/// Returns the seconds.
double follow(const Scene& scene, Way way, Hierarchy& hierarchy) {
  if (way == Way::build) return seconds_of([&] { hierarchy.build(scene.positions, scene.box); });
  std::vector<Vec3> positions = scene.positions;
  positions.resize(hierarchy.capacity());
  return seconds_of([&] {
    hierarchy.update(positions, scene.box);
    if (way == Way::repair) hierarchy.repair();
  });
}

Cost cost_of(RandomScene& scene, Way way, const Options& options) {
  Cost cost;
  const double per_particle = 1.0 / (static_cast<double>(scene.positions.size()) * options.updates);
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    scene.restart();
    Hierarchy hierarchy = hierarchy_for(scene, way);
    const SearchStats before = hierarchy.stats();
    double seconds = 0;
    for (int k = 0; k < options.updates; ++k) {
      scene.step();
      seconds += follow(scene, way, hierarchy);
    }
    cost.ns = std::min(cost.ns, 1e9 * seconds * per_particle);
    cost.orphans = static_cast<double>(hierarchy.stats().reparented - before.reparented) * per_particle;
    cost.repairs = static_cast<double>(hierarchy.stats().repairs - before.repairs) / options.updates;
    cost.builds = static_cast<double>(hierarchy.stats().builds - before.builds) / options.updates;
  }
  return cost;
}

/// To insert or remove a particle: a twentieth of them leaves and comes back [ns].
double exchange_ns(const Scene& scene) {
  Hierarchy hierarchy = hierarchy_for(scene, Way::automatic);
  const auto n = static_cast<std::int32_t>(scene.positions.size());
  std::int32_t exchanged = 0;
  const double seconds = seconds_of([&] {
    for (std::int32_t id = 1; id < n; id += 20, ++exchanged) hierarchy.remove(id);
    for (std::int32_t id = 1; id < n; id += 20, ++exchanged)
      hierarchy.insert(scene.positions[static_cast<std::size_t>(id)], id - 1);
  });
  return 1e9 * seconds / exchanged;
}

/// The scene, made to move at random alone.
std::unique_ptr<RandomScene> moving_scene(const std::string& name, const SceneOptions& options) {
  std::unique_ptr<Scene> scene = make_scene(name, options);
  auto* const moving = dynamic_cast<RandomScene*>(scene.get());
  if (moving == nullptr) throw Error(name + ": a scene from a file; choose one that moves at random");
  scene.release();
  moving->drift.clear();
  moving->strain = 0;
  moving->tethered = false;
  return std::unique_ptr<RandomScene>(moving);
}

void write_json(const std::string& path, const nlohmann::json& rows) {
  std::ofstream file(path);
  file << nlohmann::json{{"table", rows}}.dump(1) << '\n';
  if (!file.flush()) throw Error("cannot write " + path);
}

int run(const Options& options) {
  pin_to(options.processor);
  nlohmann::json rows = nlohmann::json::array();
  fmt::print(
      "ns a particle and update; step in list radii; orphans a particle; repairs and builds an update\n\n"
      "| Scene | Particles | Exchange of one | Step | Orphans | Repair | Build | Automatic | Repairs | "
      "Builds | "
      "Loss |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : options.scenes) {
    const auto scene = moving_scene(name, options.scene);
    const double exchange = exchange_ns(*scene);
    for (const double step : options.steps) {
      scene->step_length = step * scene->list_radii.back();
      const Cost repair = cost_of(*scene, Way::repair, options);
      const Cost build = cost_of(*scene, Way::build, options);
      const Cost automatic = cost_of(*scene, Way::automatic, options);
      const double chosen = automatic.builds * build.ns + automatic.repairs * repair.ns;
      const double best = std::min(repair.ns, build.ns);
      // Where repairs are put off, displacements add up until one is due, and the two ways compare otherwise.
      const bool all_decided = automatic.builds + automatic.repairs > 1 - 1e-9;
      const std::string loss = all_decided ? fmt::format("{:.0f} %", 100 * (chosen / best - 1)) : "-";
      rows.push_back({{"scene", name},
                      {"particles", scene->positions.size()},
                      {"exchange", exchange},
                      {"step", step},
                      {"orphans", repair.orphans},
                      {"repair", repair.ns},
                      {"build", build.ns},
                      {"automatic", automatic.ns},
                      {"repairs", automatic.repairs},
                      {"builds", automatic.builds},
                      {"loss", all_decided ? nlohmann::json(chosen / best - 1) : nlohmann::json()}});
      fmt::print("| {} | {} | {:.0f} | {} | {:.3f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {} |\n",
                 name, scene->positions.size(), exchange, step, repair.orphans, repair.ns, build.ns,
                 automatic.ns, automatic.repairs, automatic.builds, loss);
      std::fflush(stdout);
    }
  }
  if (!options.json.empty()) write_json(options.json, rows);
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Repairs and builds of the hierarchy after the same displacements", "dch_bench_maintenance");
  Options options;
  app.add_option("--scenes", options.scenes, "Scenes to measure")->delimiter(',');
  app.add_option("--steps", options.steps, "Largest displacements along an axis, in list radii")
      ->delimiter(',');
  app.add_option("--updates", options.updates, "Updates of a repetition")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", options.repetitions, "Repetitions, of which the fastest counts")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", options.json, "File for all rows");
  app.add_option("--processor", options.processor, "Processor to stay on")->check(CLI::NonNegativeNumber);
  app.add_option("--scale", options.scene.scale, "Particles, relative to the usual number")
      ->check(CLI::PositiveNumber);
  return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

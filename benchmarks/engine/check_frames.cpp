// SPDX-License-Identifier: MIT
//
// The lists of a hierarchy that is kept up over many configurations of a scene, each compared with a search
// that shares no code with it: see benchmarks/README.md.
#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "list_check.hpp"
#include "program.hpp"
#ifdef DCH_BENCH_HAS_LAMMPS
#include "lammps_scene.hpp"
#endif

namespace dch::bench {
namespace {

struct Options {
  std::vector<std::string> scenes;
  SceneOptions scene;
  int frames = 2000, structures = 10, superset_every = 1;
  bool lammps = false;
  std::string state;
};

std::unique_ptr<Scene> scene_of(const std::string& name, const Options& options) {
#ifdef DCH_BENCH_HAS_LAMMPS
  if (options.lammps) return make_lammps_scene(name, options.state);
#endif
  SceneOptions scene_options = options.scene;
  scene_options.most_frames = static_cast<std::size_t>(options.frames);
  scene_options.streamed = true;
  return make_scene(name, scene_options);
}

void check_scene(const std::string& name, const Options& options) {
  const std::unique_ptr<Scene> scene = scene_of(name, options);
  Contenders contenders;
  for (const char* kind : {"dch", "dch, superset"})
    for (auto& contender : make_contenders(*scene, nullptr, kind)) contenders.push_back(std::move(contender));
  const CheckedLists checked = check_lists(*scene, contenders,
                                           {.last = options.frames - 1,
                                            .expect_all = true,
                                            .structures_checked = options.structures,
                                            .superset_every = options.superset_every});
  if (checked.configurations < options.frames)
    throw Error(fmt::format("{}: {} frames are asked for, {} are there", name, options.frames,
                            checked.configurations));
  const SearchStats& stats = *contenders.front()->stats();
  fmt::print(
      "{}: {}, {} particles, {} configurations, {} pairs: none missing, none invented; structure valid at "
      "{} of them; {} updates refreshed, {} repaired, {} built\n",
      name, scene->origin, scene->positions.size(), checked.expected, checked.pairs, checked.structures,
      stats.refreshes, stats.repairs, stats.builds);
#ifdef DCH_BENCH_HAS_LAMMPS
  if (auto* running = dynamic_cast<LammpsScene*>(scene.get()); running && !options.state.empty())
    running->save(options.state);
#endif
}

int run(const Options& options) {
  if (!options.state.empty() && options.scenes.size() > 1)
    throw CLI::ValidationError("--state",
                               fmt::format("is of one scene, not of {}: name one", options.scenes.size()));
  if (const auto folder = std::filesystem::path(options.state).parent_path();
      !folder.empty() && !std::filesystem::is_directory(folder))
    throw CLI::ValidationError("--state", folder.string() + ": no such folder; make it first");
  for (const std::string& name : options.scenes) {
    check_scene(name, options);
    std::fflush(stdout);
  }
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Lists of a hierarchy kept up over many frames, compared with a search of another kind",
               "dch_check_frames");
  Options options;
  app.add_option("scenes", options.scenes, "Scenes of dch_bench_table")->required();
  app.add_option("--trajectories", options.scene.trajectories, "Folder filled by make_trajectories");
  app.add_option("--frames", options.frames, "Configurations to compare; fewer are an error")
      ->check(CLI::PositiveNumber);
  app.add_option("--superset-every", options.superset_every,
                 "Compare supersets too, at every Nth configuration")
      ->check(CLI::PositiveNumber);
  app.add_option("--structures", options.structures,
                 "Compare the structure with all pairs at so many of them; 0: never")
      ->check(CLI::NonNegativeNumber);
#ifdef DCH_BENCH_HAS_LAMMPS
  CLI::Option* const lammps = app.add_flag(
      "--lammps", options.lammps,
      "Take the melts from a LAMMPS that runs beside the check, for more frames than files can hold");
  app.add_option(
         "--state", options.state,
         "Begin with the configuration that this file keeps, if it is there; put the next one into it "
         "once all are compared")
      ->needs(lammps);
#endif
  app.add_option("--scale", options.scene.scale,
                 "Particles of artificial scenes, relative to the usual number")
      ->check(CLI::PositiveNumber);
  return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

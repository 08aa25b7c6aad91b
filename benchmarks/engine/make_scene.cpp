// SPDX-License-Identifier: MIT
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/trajectory/reader.hpp>
#include <dch/trajectory/topology.hpp>

#include "scene.hpp"

namespace dch::bench {
namespace {

/// The frames of a file.
class TrajectoryScene : public Scene {
 public:
  explicit TrajectoryScene(const std::string& path) {
    origin = std::filesystem::path(path).filename().string();
  }

  std::vector<std::int64_t> ids;  ///< of the first frame's atoms
};

/// Read before anything is timed.
class HeldTrajectory : public TrajectoryScene {
 public:
  HeldTrajectory(const std::string& path, std::size_t most_frames) : TrajectoryScene(path) {
    const auto reader = trajectory::open_trajectory(path);
    trajectory::Frame frame;
    while (frames_.size() < most_frames && reader->read(frame)) {
      if (frames_.empty()) ids = frame.ids;
      frames_.push_back({std::move(frame.positions), frame.box});
    }
    HeldTrajectory::restart();
  }
  bool step() override {
    if (next_ == frames_.size()) return false;
    positions = frames_[next_].positions;
    box = frames_[next_].box;
    ++next_;
    return true;
  }
  void restart() override {
    next_ = 0;
    step();
  }

 private:
  struct Configuration {
    std::vector<Vec3> positions;
    Box box;
  };
  std::vector<Configuration> frames_;
  std::size_t next_ = 0;
};

/// Read frame by frame, so that a file of any length will do.
class StreamedTrajectory : public TrajectoryScene {
 public:
  StreamedTrajectory(const std::string& path, std::size_t most_frames)
      : TrajectoryScene(path), path_(path), most_frames_(most_frames) {
    StreamedTrajectory::restart();
    ids = frame_.ids;
  }
  bool step() override {
    if (read_ == most_frames_ || !reader_->read(frame_)) return false;
    ++read_;
    positions.swap(frame_.positions);
    box = frame_.box;
    return true;
  }
  void restart() override {
    reader_ = trajectory::open_trajectory(path_);
    read_ = 0;
    step();
  }

 private:
  std::string path_;
  std::size_t most_frames_, read_ = 0;
  std::unique_ptr<trajectory::TrajectoryReader> reader_;
  trajectory::Frame frame_;
};

std::unique_ptr<TrajectoryScene> read_if_there(const SceneOptions& options, const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(options.trajectories) / file;
  if (options.trajectories.empty() || !std::filesystem::exists(path)) return nullptr;
  if (options.streamed) return std::make_unique<StreamedTrajectory>(path.string(), options.most_frames);
  return std::make_unique<HeldTrajectory>(path.string(), options.most_frames);
}

std::unique_ptr<Scene> make_melt(const SceneOptions& options, const std::string& file, double atoms,
                                 std::vector<double> list_radii) {
  std::unique_ptr<Scene> scene = read_if_there(options, file);
  if (!scene) {
    scene = make_shaken_lattice(atoms * options.scale, list_radii.back());
    scene->origin += ", for want of " + file;
  }
  scene->list_radii = std::move(list_radii);
  return scene;
}

/// Kremer-Grest melt, bonded pairs left out.
std::unique_ptr<Scene> make_chain_melt(const SceneOptions& options) {
  constexpr double kListRadius = 1.52;
  const std::string file = "chain32k.h5";
  std::unique_ptr<TrajectoryScene> scene = read_if_there(options, file);
  if (!scene) {
    auto lattice = make_shaken_lattice(32000 * options.scale, kListRadius);
    lattice->origin += ", for want of " + file;
    return lattice;
  }
  const auto data = std::filesystem::path(options.trajectories) / "chain32k.data";
  const trajectory::Topology topology = trajectory::read_topology(data.string(), scene->ids);
  scene->exclusions = Exclusions::from_bonds(scene->positions.size(), topology.bonds, 1);
  scene->list_radii = {kListRadius};
  return scene;
}

std::unique_ptr<Scene> make_water(const SceneOptions& options) {
  const std::string file = "water30k.trr";
  std::unique_ptr<Scene> scene = read_if_there(options, file);
  if (!scene) throw Error(file + " is not among the trajectories; make_trajectories water30k makes it");
  scene->list_radii = {1.0};
  return scene;
}

struct Maker {
  std::string name;
  std::function<std::unique_ptr<Scene>(const SceneOptions&)> make;
};

const std::vector<Maker>& makers() {
  using Options = SceneOptions;
  constexpr double kMelt = 2.8, kGas = 2000;
  static const std::vector<Maker> list = {
      {"melt4k", [](const Options& o) { return make_melt(o, "melt4k.h5", 4000, {kMelt}); }},
      {"melt32k", [](const Options& o) { return make_melt(o, "melt32k.h5", 32000, {kMelt}); }},
      {"melt256k", [](const Options& o) { return make_melt(o, "melt256k.h5", 256000, {kMelt}); }},
      {"melt1m", [](const Options& o) { return make_melt(o, "melt1m.h5", 1e6, {kMelt}); }},
      {"chain32k", [](const Options& o) { return make_chain_melt(o); }},
      {"water30k", [](const Options& o) { return make_water(o); }},
      {"droplet+gas", [](const Options& o) { return make_droplet(o.scale, kGas); }},
      {"droplet", [](const Options& o) { return make_droplet(o.scale, 0); }},
      {"clusters", [](const Options& o) { return make_power_law_clusters(o.scale); }},
      {"swollen", [](const Options& o) { return make_swollen_chain(o.scale); }},
      {"shear", [](const Options& o) { return make_sheared_lattice(o.scale); }},
      {"glass", [](const Options& o) { return make_glass(o.scale); }},
      {"hotgas", [](const Options& o) { return make_hot_gas(o.scale); }},
      {"sizes1:10", [](const Options& o) { return make_two_sizes(o.scale, 10); }},
      {"sizes1:50", [](const Options& o) { return make_two_sizes(o.scale, 50); }},
      {"colloids1:50", [](const Options& o) { return make_colloids(o.scale, 50); }},
      {"sizes1..20", [](const Options& o) { return make_continuous_sizes(o.scale, 20); }},
      {"cutoffs3",
       [](const Options& o) {
         return make_melt(o, "melt32k.h5", 32000, {1.2, 2.5, 5.0});
       }},
  };
  return list;
}

}  // namespace

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Maker& maker : makers()) all.push_back(maker.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Scene> make_scene(const std::string& name, const SceneOptions& options) {
  for (const Maker& maker : makers()) {
    if (maker.name != name) continue;
    auto scene = maker.make(options);
    scene->name = name;
    return scene;
  }
  std::string known;
  for (const std::string& other : scene_names()) known += " " + other;
  throw Error("unknown scene '" + name + "'; known:" + known);
}

}  // namespace dch::bench

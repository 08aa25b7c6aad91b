// SPDX-License-Identifier: GPL-2.0-or-later
#include "lammps_scene.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <library.h>
#include <string>

#include <dch/base/error.hpp>

#include "dch_register.h"

namespace dch::bench {
namespace {

struct Melt {
  std::string name;
  int cells;   ///< of the crystal that it starts as, along each axis
  int settle;  ///< steps before the first configuration
};

/// As in make_trajectories.
const std::array<Melt, 3> kMelts = {{{"melt32k", 20, 500}, {"melt256k", 40, 300}, {"melt1m", 63, 200}}};

struct Close {
  void operator()(void* lammps) const { lammps_close(lammps); }
};

class RunningMelt final : public LammpsScene {
 public:
  RunningMelt(const Melt& melt, const std::string& state)
      : melt_(melt), state_(std::filesystem::exists(state) ? state : "") {
    list_radii = {2.8};
    origin = state_.empty() ? "LAMMPS as it runs" : "LAMMPS as it goes on";
    start();
  }
  void save(const std::string& path) override {
    next_.wait();
    const std::string written = path + ".new";
    command("write_restart " + written);
    std::filesystem::rename(written, path);
  }
  /// Never false: there is always a next one.
  bool step() override {
    next_.get();
    positions.swap(coming_);
    box = coming_box_;
    ++steps_;
    advance("run 10 pre no post no");
    return true;
  }
  void restart() override {
    if (steps_ == 0) return;
    next_.get();
    start();
  }

 private:
  void start() {
    open();
    take();
    positions.swap(coming_);
    box = coming_box_;
    steps_ = 0;
    advance("run 10 post no");
  }

  void open() {
    lammps_.reset();
    std::array<std::string, 7> words = {"dch_check_frames", "-log", "none", "-screen", "none",
                                        "-suffix",          "dch"};
    std::array<char*, 7> arguments{};
    for (std::size_t k = 0; k < words.size(); ++k) arguments[k] = words[k].data();
    lammps_.reset(lammps_open_no_mpi(static_cast<int>(arguments.size()), arguments.data(), nullptr));
    if (!lammps_ || dch_register(lammps_.get()) != 0) throw Error("LAMMPS does not start");
    command("dch precision mixed");
    if (!state_.empty())
      go_on();
    else
      settle();
    const double atoms = lammps_get_natoms(lammps_.get()), expected = 4 * std::pow(melt_.cells, 3);
    if (atoms != expected)
      throw Error(state_ + " has " + std::to_string(std::llround(atoms)) + " atoms, " + melt_.name + " has " +
                  std::to_string(std::llround(expected)) + ": give a state that this scene has saved");
  }

  void settle() {
    for (const std::string& variable :
         {"cells equal " + std::to_string(melt_.cells), "settle equal " + std::to_string(melt_.settle),
          std::string("steps equal 0"), std::string("data string /dev/null"),
          std::string("frames string /dev/null")})
      command("variable " + variable);
    lammps_file(lammps_.get(), DCH_MELT_INPUT);
    command("undump frames");
  }

  /// What in.melt says and a restart file does not keep.
  void go_on() {
    command("read_restart " + state_);
    command("neighbor 0.3 bin");
    command("neigh_modify delay 0 every 5 check yes");
    command("fix move all nve");
  }

  void command(const std::string& line) { lammps_command(lammps_.get(), line.c_str()); }

  /// Copies what LAMMPS has now, in the order of the atoms' IDs.
  void take() {
    coming_.resize(static_cast<std::size_t>(lammps_get_natoms(lammps_.get())));
    std::string what = "x";
    lammps_gather_atoms(lammps_.get(), what.data(), 1, 3, coming_.data());
    std::array<double, 3> low{}, high{};
    double xy = 0, yz = 0, xz = 0;
    std::array<int, 3> periodic{};
    int changes = 0;
    lammps_extract_box(lammps_.get(), low.data(), high.data(), &xy, &yz, &xz, periodic.data(), &changes);
    coming_box_ = Box::orthorhombic({high[0] - low[0], high[1] - low[1], high[2] - low[2]},
                                    {true, true, true}, {low[0], low[1], low[2]});
  }

  void advance(const char* run) {
    next_ = std::async(std::launch::async, [this, run] {
      command(run);
      take();
    });
  }

  Melt melt_;
  std::string state_;  ///< to begin with; empty: as a crystal
  std::unique_ptr<void, Close> lammps_;
  std::vector<Vec3> coming_;
  Box coming_box_;
  int steps_ = 0;
  std::future<void> next_;  ///< the last member, so that it ends before what it uses
};

}  // namespace

std::unique_ptr<LammpsScene> make_lammps_scene(const std::string& name, const std::string& state) {
  for (const Melt& melt : kMelts) {
    if (melt.name != name) continue;
    auto scene = std::make_unique<RunningMelt>(melt, state);
    scene->name = name;
    return scene;
  }
  throw Error("LAMMPS has no scene '" + name + "'; it has melt32k, melt256k and melt1m");
}

}  // namespace dch::bench

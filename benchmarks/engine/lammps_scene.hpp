// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>

#include "scene.hpp"

namespace dch::bench {

/// The configurations of inputs/in.melt, 10 steps apart, from a LAMMPS in this program: for more of them than
/// files can hold. LAMMPS goes on to the next one on a thread of its own while the present one is looked at.
/// It computes forces with lj/cut/dch in mixed precision.
class LammpsScene : public Scene {
 public:
  /// Writes the state of the configuration after the present one, for a later program to begin with.
  virtual void save(const std::string& path) = 0;
};

/// @param name melt32k, melt256k or melt1m
/// @param state file by save() to begin with; empty or not there: the scene's first configuration
/// @throws Error for another name, or a state of another number of atoms
std::unique_ptr<LammpsScene> make_lammps_scene(const std::string& name, const std::string& state);

}  // namespace dch::bench

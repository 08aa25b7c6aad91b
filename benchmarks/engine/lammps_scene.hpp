// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <memory>
#include <string>

#include "scene.hpp"

namespace dch::bench {

/// The configurations of inputs/in.melt, 10 steps apart, from a LAMMPS in this program: for more of them than
/// files can hold. LAMMPS goes on to the next one on a thread of its own while the present one is looked at.
/// It computes forces with lj/cut/dch in mixed precision.
/// @param name melt32k, melt256k or melt1m
/// @throws Error for another name
std::unique_ptr<Scene> make_lammps_scene(const std::string& name);

}  // namespace dch::bench

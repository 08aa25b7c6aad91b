// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scene.hpp"

namespace dch::bench {

/// Writes the present configuration for programs in other languages: FOLDER/NAME.f64, three doubles for each
/// particle in the machine's byte order, and FOLDER/NAME.json with the number of particles, the sides of the
/// box, the list radii and for each of them the number of pairs that expected_pairs() finds. Exclusions are
/// dropped first.
/// @throws Error if particles have radii, the box is not a periodic cuboid at the origin, or a file cannot be
///   written.
void write_scene(Scene& scene, const std::string& folder);

}  // namespace dch::bench

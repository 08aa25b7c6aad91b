// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dch::cli {

/// A part of a run.
struct SphereBlock {
  double time = 0;              ///< at its end
  std::int64_t collisions = 0;  ///< in it
  double pressure = 0;          ///< over that of an ideal gas of the energy of then
  double energy = 0;            ///< kinetic, at its end
  double seconds = 0;           ///< of wall clock
};

/// Growth until the spheres were jammed.
struct SphereJam {
  double rate = 0, fraction = 0, pressure = 0;
  bool is_jammed = false;
};

/// All that `dchmd hardspheres` did; its table and its JSON show nothing else.
struct SphereReport {
  std::string from;  ///< restart file, "lattice" or "random"
  std::int64_t spheres = 0;
  double smallest_diameter = 0, largest_diameter = 0, edge = 0;
  double start_fraction = 0;  ///< with which spheres began to grow, if they had to
  std::int64_t growth_collisions = 0;
  double fraction = 0;
  double restitution = 1;
  double begin = 0, end = 0;  ///< time
  double energy_at_start = 0;
  double least_gap = 0;          ///< over the distance of a pair
  double expected_pressure = 0;  ///< of the equation of state, at `fraction`
  std::int64_t frames = 0;       ///< written
  std::optional<SphereJam> jam;
  std::vector<SphereBlock> blocks;

  std::int64_t collisions() const;
  /// Mean over the second half of the blocks, by time; none without two blocks.
  std::optional<double> pressure() const;
  double microseconds_a_collision() const;
  /// Change of the energy over the energy at the start.
  double energy_drift() const;
  bool is_monodisperse() const { return smallest_diameter == largest_diameter; }
};

std::string render_json(const SphereReport& report);
std::string render_table(const SphereReport& report);

}  // namespace dch::cli

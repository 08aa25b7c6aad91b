// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "report.hpp"

/// The parts of the program: each prints a table and hands it back. Wrong answers end them with dch::Error.
namespace dch::bench {

/// Visited pairs of chains of up to so many beads (Theorem 4.5.1).
Table measure_growth(std::int64_t most_beads);

/// Radii of layered over those of wrapped cages (Theorem 4.4.1): of the tight set, of chains that are made
/// here, and of a trajectory's first frame if one is named, whose chains of `chain_beads` beads stand one
/// after the other.
Table measure_radii(std::int64_t most_beads, const std::string& trajectory, int chain_beads);

/// Verification and repair over the frames of one open chain, against building for each frame.
Table measure_motion(const std::string& trajectory, int most_frames);

/// Contact queries of chains of so many beads by all structures of the library, on so many threads by those
/// that can. Positions go to `folder`, if one is named, for other programs: NAME.positions, three doubles
/// a bead.
Table measure_queries(int beads, int rounds, int threads, const std::string& folder);

/// Repair of the power diagram of chains of so many beads against building it, by size of their steps.
Table measure_diagram(int beads, int rounds);

/// Writes a LAMMPS data file of a swollen chain, which bead-spring dynamics can start from.
void write_chain(const std::string& path, int beads);

}  // namespace dch::bench

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/exclusions.hpp>
#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// Bonds between the atoms of a frame, as indices into its arrays (atoms in ascending order of id).
struct Topology {
  std::vector<IndexPair> bonds;
  std::string source;  ///< where they came from, for messages
};

/// Reads bonds from a LAMMPS data file (.data, .lmp, data.*), a text file of bonds (.bonds: two ids a line)
/// or of chains (.chains: the ids of one chain in order a line, or ranges first-last, "ring" first for closed
/// ones); '#' starts a comment.
/// @param ids the frame's ids, ascending
/// @throws FileError naming file and line for unknown endings, unknown ids, bonds of an atom with itself.
Topology read_topology(const std::string& path, const std::vector<std::int64_t>& ids);

/// Chains from the molecule column: the atoms of a molecule, in order of id, are bonded one after the other.
/// Molecule 0 means "none" (LAMMPS).
/// @throws FileError if the frame has no molecule column.
Topology topology_from_molecules(const Frame& frame, const std::string& path);

}  // namespace dch::trajectory

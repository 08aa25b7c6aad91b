// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/lists/exclusions.hpp>
#include <dch/trajectory/frame.hpp>
#include <dch/trajectory/reader.hpp>

namespace dch::trajectory {

/// Atoms in order along a chain, as indices into the arrays of a frame.
struct AtomChain {
  std::vector<std::int32_t> atoms;
  bool closed = false;    ///< the last is bonded to the first
  std::int64_t line = 0;  ///< of the file that says so, from 1
};

/// Bonds between the atoms of a frame, as indices into its arrays (atoms in ascending order of id).
struct Topology {
  std::vector<IndexPair> bonds;
  std::string source;             ///< where they came from, for messages
  std::vector<AtomChain> chains;  ///< of a file of chains, in its order; else empty, and bonds tell all
};

/// Reads bonds from a LAMMPS data file (.data, .lmp, data.*), a text file of bonds (.bonds: two ids a line)
/// or of chains (.chains: the ids of one chain in order a line, or ranges first-last, "ring" first for closed
/// ones); '#' starts a comment.
/// @param ids the frame's ids, ascending
/// @throws FileError naming file and line for unknown endings, unknown ids, bonds of an atom with itself,
/// ranges
///   that name every atom more than 16 times.
Topology read_topology(const std::string& path, const std::vector<std::int64_t>& ids,
                       const ReadLimits& limits = {});

/// Chains from the molecule column: the atoms of a molecule, in order of id, are bonded one after the other.
/// Molecule 0 means "none" (LAMMPS).
/// @throws FileError if the frame has no molecule column.
Topology topology_from_molecules(const Frame& frame, const std::string& path);

}  // namespace dch::trajectory

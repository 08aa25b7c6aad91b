// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/lists/exclusions.hpp>
#include <dch/trajectory/topology.hpp>

#include "frames/atom_index.hpp"

namespace dch::trajectory {

/// Bonds of the section "Bonds" of a LAMMPS data file (docs.lammps.org/read_data.html); all else is passed
/// over.
/// @throws FileError if there are fewer or more than the header says, or for ids that are not in the index.
std::vector<IndexPair> read_lammps_data_bonds(const std::string& path, const AtomIndex& atoms,
                                              const ReadLimits& limits);

/// Bonds of a text file, two ids a line. @throws FileError.
std::vector<IndexPair> read_bonds_text(const std::string& path, const AtomIndex& atoms,
                                       const ReadLimits& limits);

/// The chains of a text file, and the bonds along them: one chain a line, ids or ranges "first-last" in
/// order, the word "ring" in front of a closed one. @throws FileError.
Topology read_chains_text(const std::string& path, const AtomIndex& atoms, const ReadLimits& limits);

/// A bond; refuses one of an atom with itself.
IndexPair make_bond(const LineReader& lines, std::int32_t a, std::int32_t b);

}  // namespace dch::trajectory

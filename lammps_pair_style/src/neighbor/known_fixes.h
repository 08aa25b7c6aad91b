// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {

inline constexpr const char* kHistoryFix = "NEIGH_HISTORY";  ///< LAMMPS's own, of granular contacts

/// Whether fixes of this style are known to draw no random numbers in the order of atoms: with the others,
/// atoms in another order, or in this order at other steps, take another trajectory.
bool draws_no_random_numbers(const char* style);

/// Whether fixes, or computes, of this style are known to look at no ghost.
bool is_fix_without_ghosts(const char* style);
bool is_compute_without_ghosts(const char* style);

}  // namespace LAMMPS_NS

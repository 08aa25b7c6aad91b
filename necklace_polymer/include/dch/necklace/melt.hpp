// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// A melt of linear bead-spring chains (Kremer and Grest, J. Chem. Phys. 92:5057, 1990). Lengths in units of
/// the bead diameter sigma.
struct MeltParams {
  std::int32_t chains = 320;           ///< >= 1
  std::int32_t beads_per_chain = 100;  ///< >= 1
  double density = 0.8442;             ///< beads per volume, > 0 [1/length^3]
  double bond = 0.97;                  ///< > 0 [length]
  /// Smallest distance of next-nearest beads along a chain, 0 .. 1.9 bond [length]: random walks without it
  /// fold back onto themselves, and the push-off has to undo that.
  double min_distance_13 = 1.02;
  std::uint64_t seed = 1;
};

/// Particle k is bead k mod beads_per_chain of chain k / beads_per_chain.
struct Melt {
  Box box;                                          ///< cubic, periodic, origin at 0
  std::vector<Vec3> positions;                      ///< inside the box [length]
  std::vector<std::array<std::int32_t, 3>> images;  ///< how often each bead's walk has left the box, per axis
  std::vector<std::int32_t> molecules;              ///< 1 .. chains
  std::vector<IndexPair> bonds;                     ///< along each chain
};

/// Random walks at the melt's density, started at random places. **Beads overlap**: a soft push-off has to
/// come before any dynamics (Auhl et al., J. Chem. Phys. 119:12718, 2003). The same parameters give the same
/// bits on every platform with IEEE arithmetic: the random numbers are std::mt19937_64's, transformed here by
/// correctly rounded operations only. O(n).
/// @throws InvalidParameter for a parameter out of its range, more than 2^31 - 1 beads, and a box narrower
/// than four
///   bonds, in which bonds could meet their own images.
Melt make_melt(const MeltParams& params);

/// Writes a LAMMPS data file: sections Masses (one type, mass 1), `Atoms # bond` (id mol type x y z ix iy iz)
/// and Bonds (one type), ids from 1. Coordinates have enough digits to be read back exactly, whatever the
/// locale. Whether all of it was written is for the stream to say.
void write_lammps_data(std::ostream& out, const Melt& melt);

}  // namespace dch::necklace
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dch::trajectory {

/// What the columns of a LAMMPS dump hold.
struct DumpColumns {
  enum class Role { ignored, id, molecule, type, x, y, z, ix, iy, iz };

  std::vector<Role> roles;  ///< one per column
  bool scaled = false;      ///< x, y, z are fractions of the box (xs, xsu)
  bool unwrapped = false;   ///< x, y, z are unwrapped (xu, xsu): image flags do not apply to them
  bool has_id = false;
  bool has_molecule = false;
  bool has_type = false;
  bool has_images = false;
};

/// Reads the names after "ITEM: ATOMS". Of several sets of coordinates the first complete one of x y z, xu yu
/// zu, xs ys zs, xsu ysu zsu is taken: absolute ones lose the fewest digits. Returns an empty string, or what
/// is wrong (a repeated column, no complete set of coordinates).
std::string parse_dump_columns(std::string_view names, DumpColumns& columns);

}  // namespace dch::trajectory

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace dch::lammps {

/// While `dch on` takes another style in place of a plain one, LAMMPS's table of styles has the plain one by
/// its name with this behind it. Scripts can name it too.
inline constexpr const char* kStock = "/stock";

/// The name by which a table of LAMMPS's styles has LAMMPS's own style of this name.
template <class Styles>
std::string stock_name(const Styles& styles, const std::string& plain) {
  const std::string moved = plain + kStock;
  return styles.count(moved) > 0 ? moved : plain;
}

}  // namespace dch::lammps

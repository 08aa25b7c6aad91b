// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <istream>
#include <string>

namespace dch::lammps {

/// The distance at which a section of a file of tables begins, read as pair_style table of LAMMPS reads it; 0
/// if there is no such section, or it says nothing that is understood.
double first_distance(std::istream& file, const std::string& keyword);

}  // namespace dch::lammps

// SPDX-License-Identifier: MIT
#include "lammps/lammps_units.hpp"

#include <algorithm>
#include <iterator>

namespace dch::trajectory {
namespace {

constexpr LammpsUnits kStyles[] = {
    {"lj", "sigma", 0},  {"metal", "Angstrom", 1},   {"real", "Angstrom", 1e-3},   {"si", "m", 1e12},
    {"cgs", "cm", 1e12}, {"electron", "Bohr", 1e-3}, {"micro", "micrometer", 1e6}, {"nano", "nm", 1e3},
};

template <class Matches>
const LammpsUnits* find(const Matches& matches) {
  const auto* found = std::find_if(std::begin(kStyles), std::end(kStyles), matches);
  return found == std::end(kStyles) ? nullptr : found;
}

}  // namespace

const LammpsUnits* find_lammps_units(std::string_view style) {
  return find([=](const LammpsUnits& units) { return units.style == style; });
}

const LammpsUnits* find_lammps_units_by_length(std::string_view length) {
  return find([=](const LammpsUnits& units) { return units.length == length; });
}

}  // namespace dch::trajectory

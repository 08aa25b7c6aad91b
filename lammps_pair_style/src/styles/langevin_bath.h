// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <atom.h>
#include <lammps_host.h>
#include <pointers.h>
#include <string>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

/// Drag and strength of the random force of atoms in a bath, by the operations of fix langevin, in its order.
class LangevinBath : protected Pointers {
 public:
  /// Whose damping has the same ratio for all types.
  explicit LangevinBath(LAMMPS* lammps);

  double start = 0, stop = 0;  ///< temperatures of a run
  double damping = 0;          ///< [time]
  std::string variable;        ///< of the temperature; empty if it is a number
  std::vector<double> ratio;   ///< of damping, by type

  /// Whether the temperature is a number or LAMMPS has its variable, of style equal.
  bool is_of_all_atoms() const;
  /// At the start of a run, and when the time step changes.
  void take_prefactors();
  /// Of the bath at this step; of each atom of the group if the variable is of style atom.
  void take_temperature(int group_number, const std::string& name_in_messages);
  double temperature() const { return temperature_; }

  double drag(int atom) const;
  double strength(int atom) const;
  /// Where the temperature is that of all atoms, and masses are those of types.
  double strength_of_type(int type) const { return strength_[static_cast<std::size_t>(type)] * root_; }
  /// Adds the forces of so much noise to atoms, kMostInRun at most, in ascending order.
  void add_forces(const int* atoms, dch::Span<const dch::Vec3> noise) const;

 private:
  std::vector<double> drag_, strength_;  ///< by type; strength at a temperature of 1
  double temperature_ = 0, root_ = 0;
  bool is_of_atoms_ = false;
  std::vector<double> temperatures_;  ///< of atoms, if is_of_atoms_
};

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstdio>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#include "explained.h"
#include "plain_style.h"

namespace LAMMPS_NS {

/// What bond and angle styles whose forces come from a SIMD kernel have in common. Everything else is the
/// plain style's, of which they keep an object, which also computes at steps that want energy or virials by
/// atom, and always if newton is off for bonds.
/// @tparam Style LAMMPS's Bond or Angle
template <class Style>
class BondedDCH : public Style, public Explained {
 public:
  ~BondedDCH() override;
  BondedDCH(const BondedDCH&) = delete;
  BondedDCH& operator=(const BondedDCH&) = delete;

  void init_style() override;
  void compute(int eflag, int vflag) override;
  void coeff(int narg, char** arg) override;
  void write_restart(std::FILE* file) override;
  void read_restart(std::FILE* file) override;
  void write_data(std::FILE* file) override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  BondedDCH(LAMMPS* lammps, PlainStyle<Style> plain);

  virtual int types() const = 0;
  virtual int bonds_here() const = 0;  ///< or angles, that this process computes
  /// @param values coefficients of the first kind of all types, then of the next, as in restart files
  virtual void make_kernel(const std::vector<double>& values) = 0;
  /// Only called where this process has bonds or angles.
  /// @param positions of owned atoms and ghosts, as are the forces
  /// @param sums of the virial, only of use if they are wanted; added to
  virtual void add_forces(dch::Span<const dch::Vec3> positions, dch::Span<dch::Vec3> forces,
                          bool wants_virial, std::array<double, 6>& sums) = 0;
  /// Takes over what only this kind of plain style has computed by atom.
  virtual void copy_more_sums(int /*atoms*/) {}

  void forget_kernel() { has_kernel_ = false; }

  PlainStyle<Style> plain_;

 private:
  void take_coefficients();
  void compute_plain(int eflag, int vflag);

  bool has_kernel_ = false;   ///< of the coefficients as they are
  dch::lammps::Turns turns_;  ///< of this run
};

}  // namespace LAMMPS_NS

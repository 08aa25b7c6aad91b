// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <bond.h>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/forces/fene.hpp>

#include "explained.h"
#include "plain_style.h"

namespace LAMMPS_NS {

/// A bond style whose forces come from a SIMD kernel. Everything else is the plain style's, of which it keeps
/// an object, which also computes at steps that want energy or virials by atom, and always if newton is off
/// for bonds.
class BondDCH : public Bond, public Explained {
 public:
  ~BondDCH() override;
  BondDCH(const BondDCH&) = delete;
  BondDCH& operator=(const BondDCH&) = delete;

  void init_style() override;
  void compute(int eflag, int vflag) override;
  void coeff(int narg, char** arg) override;
  double equilibrium_distance(int type) override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_data(FILE* file) override;
  double single(int type, double rsq, int i, int j, double& fforce) override;
  void* extract(const char* name, int& dimension) override;
  void reinit() override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  /// @param plain_style the plain style's name
  /// @param coefficients how many numbers a type has
  BondDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients);

  /// @param values coefficients of the first kind of all types, then of the next, as in restart files
  virtual void make_kernel(const std::vector<double>& values) = 0;

  /// @param sums of the virial, only of use if they are wanted; added to
  virtual void add_forces(dch::Span<const dch::BondOfType> bonds, dch::Span<const dch::Vec3> positions,
                          dch::Span<dch::Vec3> forces, bool wants_virial, std::array<double, 6>& sums) = 0;

  PlainStyle<Bond> plain_;

 private:
  void take_coefficients();
  void compute_plain(int eflag, int vflag);

  bool has_kernel_ = false;   ///< of the coefficients as they are
  dch::lammps::Turns turns_;  ///< of this run
};

}  // namespace LAMMPS_NS

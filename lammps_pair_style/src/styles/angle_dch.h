// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <angle.h>
#include <lammps_host.h>
#include <optional>
#include <vector>

#include <dch/forces/angles.hpp>

#include "explained.h"
#include "plain_style.h"

namespace LAMMPS_NS {

/// An angle style whose forces come from a SIMD kernel. Everything else is the plain style's, of which it
/// keeps an object, which also computes at steps that want energy or virials by atom, and always if newton is
/// off for bonds.
class AngleDCH : public Angle, public Explained {
 public:
  ~AngleDCH() override;
  AngleDCH(const AngleDCH&) = delete;
  AngleDCH& operator=(const AngleDCH&) = delete;

  void init_style() override;
  void compute(int eflag, int vflag) override;
  void coeff(int narg, char** arg) override;
  double equilibrium_angle(int type) override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_data(FILE* file) override;
  double single(int type, int i, int apex, int k) override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  /// @param plain_style the plain style's name
  /// @param coefficients how many numbers a type has
  AngleDCH(LAMMPS* lammps, const char* plain_style, std::size_t coefficients);

  /// @param values coefficients of the first kind of all types, then of the next, as in restart files
  virtual dch::AngleForces make_kernel(const std::vector<double>& values) const = 0;

 private:
  void take_coefficients();
  void compute_plain(int eflag, int vflag);

  PlainStyle<Angle> plain_;
  std::optional<dch::AngleForces> kernel_;  ///< of the coefficients as they are
  dch::lammps::Turns turns_;                ///< of this run
};

}  // namespace LAMMPS_NS

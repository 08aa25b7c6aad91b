// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS
// clang-format off
FixStyle(langevin/philox,FixLangevinPhilox);
// clang-format on
#elif !defined(LMP_FIX_LANGEVIN_PHILOX_H)
#define LMP_FIX_LANGEVIN_PHILOX_H

#include <cstdint>
#include <fix.h>
#include <lammps_host.h>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>

#include "explained.h"

namespace LAMMPS_NS {

/// langevin/philox: drag and random forces of fix langevin, with random numbers that depend on seed, atom ID
/// and step alone. `suffix dch` does not find it, as it takes other numbers than fix langevin.
class FixLangevinPhilox : public Fix, public Explained {
 public:
  FixLangevinPhilox(LAMMPS* lammps, int narg, char** arg);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int) override;
  void reset_dt() override;
  int modify_param(int narg, char** arg) override;
  dch::lammps::StyleNote explain() const override {
    return {"langevin/philox", "SIMD kernel, random numbers by seed, atom ID and step"};
  }

 private:
  void read_keywords(int narg, char** arg);
  void read_scale(const char* type, const char* ratio);
  void take_prefactors();
  double temperature();
  void add_forces(const int* atoms, int count, double root_of_temperature);
  void subtract_mean(double root_of_temperature);

  std::string name_;      ///< how messages begin
  std::string variable_;  ///< of the temperature; empty if it is a number
  double start_ = 0, stop_ = 0;
  double damping_ = 0;  ///< [time]
  std::uint32_t seed_ = 0;
  bool is_zeroed_ = false;
  std::vector<double> ratio_, drag_, strength_;  ///< by type; strength at a temperature of 1
  std::vector<dch::Vec3> sums_;                  ///< of noise at this step, by type, if is_zeroed_
};

}  // namespace LAMMPS_NS

#endif

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
#include "langevin_bath.h"

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
  void reset_target(double temperature) override;
  void reset_dt() override;
  void* extract(const char* name, int& dimension) override;
  int modify_param(int narg, char** arg) override;
  dch::lammps::StyleNote explain() const override {
    return {"langevin/philox", "SIMD kernel, random numbers by seed, atom ID and step"};
  }

 private:
  void read_keywords(int narg, char** arg);
  void read_scale(const char* type, const char* ratio);
  void add_forces(const int* atoms, int count);
  void subtract_mean();

  std::string name_;  ///< how messages begin
  LangevinBath bath_;
  std::uint32_t seed_ = 0;
  bool is_zeroed_ = false;
  double target_ = 0;            ///< temperature, for others
  std::vector<dch::Vec3> sums_;  ///< of noise at this step, by type, if is_zeroed_
};

}  // namespace LAMMPS_NS

#endif

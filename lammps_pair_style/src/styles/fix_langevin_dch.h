// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS
// clang-format off
FixStyle(langevin/dch,FixLangevinDCH);
// clang-format on
#elif !defined(LMP_FIX_LANGEVIN_DCH_H)
#define LMP_FIX_LANGEVIN_DCH_H

#include <fix.h>
#include <lammps_host.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/forces/langevin.hpp>

#include "explained.h"
#include "langevin_bath.h"

namespace LAMMPS_NS {

class Compute;

/// langevin/dch: the random numbers and operations of fix langevin, in its order, by SIMD kernels: forces
/// have its bits. It keeps an object of the plain style, which reads the arguments, and computes what the
/// kernels do not know.
class FixLangevinDCH : public Fix, public Explained {
 public:
  FixLangevinDCH(LAMMPS* lammps, int narg, char** arg);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void post_force(int vflag) override;
  void post_force_respa(int vflag, int level, int loop) override;
  void end_of_step() override;
  void reset_target(double temperature) override;
  void reset_dt() override;
  int modify_param(int narg, char** arg) override;
  double compute_scalar() override;
  double memory_usage() override;
  void* extract(const char* name, int& dimension) override;
  void grow_arrays(int most) override;
  void copy_arrays(int from, int to, int is_deleted) override;
  int pack_exchange(int atom, double* to) override;
  int unpack_exchange(int atom, double* from) override;
  dch::lammps::StyleNote explain() const override;

 private:
  void read_keywords(int narg, char** arg);
  void take_bias();
  void add_forces(const int* atoms, int count);
  void add_force_without_bias(int atom, dch::Vec3 noise);
  void subtract_mean();

  std::string name_;  ///< how messages begin
  std::unique_ptr<Fix> plain_;
  LangevinBath bath_;
  dch::RanmarNoise noise_;
  bool is_zeroed_ = false, has_drawn_ = false;
  dch::Vec3 sum_;          ///< of random forces at this step, if is_zeroed_
  std::string by_plain_;   ///< why the plain style computes; empty if it does not
  std::string bias_name_;  ///< of a compute, by fix_modify temp
  Compute* bias_ = nullptr;
  double target_ = 0;  ///< temperature, for others
};

}  // namespace LAMMPS_NS

#endif

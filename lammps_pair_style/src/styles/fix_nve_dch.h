// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/dch,FixNVEDCH);
// clang-format on
#elif !defined(LMP_FIX_NVE_DCH_H)
#define LMP_FIX_NVE_DCH_H

#include <fix.h>
#include <lammps_host.h>
#include <memory>
#include <vector>

#include "explained.h"

namespace LAMMPS_NS {

/// nve/dch: the operations of fix nve, in its order, by SIMD kernels: positions and velocities have its bits.
/// It keeps an object of the plain style, which knows the steps of r-RESPA and computes there.
class FixNVEDCH : public Fix, public Explained {
 public:
  FixNVEDCH(LAMMPS* lammps, int narg, char** arg);

  int setmask() override;
  void init() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void initial_integrate_respa(int vflag, int level, int loop) override;
  void final_integrate_respa(int level, int loop) override;
  void reset_dt() override;
  dch::lammps::StyleNote explain() const override;

 private:
  /// Calls act(first, count, half a step over the mass of each) for the group's atoms.
  template <class Act>
  void for_atoms(Act act);
  void take_step();

  std::unique_ptr<Fix> plain_;
  double step_ = 0, half_step_ = 0;          ///< [time], [time ftm2v]
  std::vector<double> half_step_over_mass_;  ///< by type
  dch::lammps::Turns turns_;                 ///< of this run
};

}  // namespace LAMMPS_NS

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(dch/work,ComputeDCHWork);
// clang-format on
#elif !defined(LMP_COMPUTE_DCH_WORK_H)
#define LMP_COMPUTE_DCH_WORK_H

#include <compute.h>
#include <lammps_host.h>
#include <string>

namespace LAMMPS_NS {

/// dch/work: by atom, how many pairs its process looks at for it in the last lists, and 1 for the atom
/// itself. Of every pair that two atoms of a process share, each has one half. A fix keeps the numbers.
class ComputeDCHWork : public Compute {
 public:
  ComputeDCHWork(LAMMPS* lammps, int narg, char** arg);
  ~ComputeDCHWork() override;
  ComputeDCHWork(const ComputeDCHWork&) = delete;
  ComputeDCHWork& operator=(const ComputeDCHWork&) = delete;

  void init() override {}
  void compute_peratom() override;

 private:
  std::string fix_id_;
};

}  // namespace LAMMPS_NS

#endif

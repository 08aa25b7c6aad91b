// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef ANGLE_CLASS
// clang-format off
AngleStyle(cosine/dch,AngleCosineDCH);
// clang-format on
#elif !defined(LMP_ANGLE_COSINE_DCH_H)
#define LMP_ANGLE_COSINE_DCH_H

#include "angle_dch.h"

namespace LAMMPS_NS {

/// cosine/dch: bonds of semiflexible chains.
class AngleCosineDCH : public AngleDCH {
 public:
  explicit AngleCosineDCH(LAMMPS* lammps);

 private:
  void make_kernel(const std::vector<double>& values) override;
};

}  // namespace LAMMPS_NS

#endif

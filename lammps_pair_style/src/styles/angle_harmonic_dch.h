// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef ANGLE_CLASS
// clang-format off
AngleStyle(harmonic/dch,AngleHarmonicDCH);
// clang-format on
#elif !defined(LMP_ANGLE_HARMONIC_DCH_H)
#define LMP_ANGLE_HARMONIC_DCH_H

#include "angle_dch.h"

namespace LAMMPS_NS {

/// harmonic/dch: springs between bonds that meet.
class AngleHarmonicDCH : public AngleDCH {
 public:
  explicit AngleHarmonicDCH(LAMMPS* lammps);

 private:
  void make_kernel(const std::vector<double>& values) override;
};

}  // namespace LAMMPS_NS

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "run_report.h"

namespace LAMMPS_NS {

/// A style that says how it has computed in the last run, and why so, for `dch explain`.
class Explained {
 public:
  virtual dch::lammps::StyleNote explain() const = 0;
  /// Says that `dch on` has taken this style, not the script: what suits the run decides how it computes.
  virtual void choose() {}

 protected:
  ~Explained() = default;  // styles are deleted as those of LAMMPS, whose destructors may throw
};

}  // namespace LAMMPS_NS

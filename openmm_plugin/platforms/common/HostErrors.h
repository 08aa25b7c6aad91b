// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_HOST_ERRORS_H_
#define OPENMM_DCH_HOST_ERRORS_H_

#include <openmm/OpenMMException.h>
#include <string>

#include <dch/base/error.hpp>

namespace OpenMMDCH {

/// Runs f, and throws errors of the library as OpenMM's callers know them.
template <class F>
auto withErrorsOfHost(const F& f) {
  try {
    return f();
  } catch (const dch::Error& e) {
    throw OpenMM::OpenMMException(std::string("openmm_dch: ") + e.what());
  }
}

}  // namespace OpenMMDCH

#endif

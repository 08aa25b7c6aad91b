// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_HOST_STATE_H_
#define OPENMM_DCH_HOST_STATE_H_

#include <openmm/Vec3.h>
#include <openmm/internal/ContextImpl.h>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>

namespace OpenMMDCH {

/// The arrays of a Context on a platform on the processor, and its box, none where a force is not periodic.
struct HostState {
  dch::Span<const dch::Vec3> positions;  ///< [nm]
  dch::Span<dch::Vec3> forces;           ///< to be added to [kJ/mol/nm]
  dch::Box box;
};

HostState hostStateOf(OpenMM::ContextImpl& context, bool isPeriodic);
/// The three vectors of the Context's box [nm].
const OpenMM::Vec3* boxVectorsOf(OpenMM::ContextImpl& context);
/// The periodic box that OpenMM's three vectors span.
dch::Box boxOf(const OpenMM::Vec3* vectors);

/// What is left for a skin beside the cutoff in this box: a given fraction of the cutoff at most, negative if
/// lists of that cutoff cannot be made. OpenMM lets the cutoff be half the width of the box along each axis,
/// lists half of its smallest perpendicular height, which is less in a few skewed boxes.
double roomForSkin(double cutoff, double fraction, const dch::Box& box);

}  // namespace OpenMMDCH

#endif

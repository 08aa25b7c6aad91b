// SPDX-License-Identifier: MIT
#include "HostState.h"

#include <algorithm>
#include <openmm/reference/ReferencePlatform.h>

namespace OpenMMDCH {
namespace {

static_assert(sizeof(OpenMM::Vec3) == sizeof(dch::Vec3), "both are three doubles");

dch::Vec3 vectorOf(const OpenMM::Vec3& v) { return {v[0], v[1], v[2]}; }

// The CPU platform is a ReferencePlatform too.
OpenMM::ReferencePlatform::PlatformData& dataOf(OpenMM::ContextImpl& context) {
  return *static_cast<OpenMM::ReferencePlatform::PlatformData*>(context.getPlatformData());
}

}  // namespace

HostState hostStateOf(OpenMM::ContextImpl& context, bool isPeriodic) {
  auto& data = dataOf(context);
  HostState state;
  state.positions = {reinterpret_cast<const dch::Vec3*>(data.positions->data()), data.positions->size()};
  state.forces = {reinterpret_cast<dch::Vec3*>(data.forces->data()), data.forces->size()};
  if (isPeriodic) state.box = boxOf(data.periodicBoxVectors);
  return state;
}

const OpenMM::Vec3* boxVectorsOf(OpenMM::ContextImpl& context) { return dataOf(context).periodicBoxVectors; }

dch::Box boxOf(const OpenMM::Vec3* vectors) {
  return dch::Box::triclinic(vectorOf(vectors[0]), vectorOf(vectors[1]), vectorOf(vectors[2]));
}

double roomForSkin(double cutoff, double fraction, const dch::Box& box) {
  constexpr double kRounding = 1e-9;  // keeps clear of what rounds to more than half of the height
  return std::min(fraction * cutoff, box.max_cutoff() * (1 - kRounding) - cutoff);
}

}  // namespace OpenMMDCH

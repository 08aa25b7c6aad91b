// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/forces/grain_contacts.hpp>

namespace dch::detail {

/// Grains and listed pairs; see GrainContacts.
struct ContactTask {
  const Vec3 *positions, *velocities, *spins;
  const GrainBody* bodies;
  Vec3 *forces, *torques;  ///< added to
  std::int32_t owned;
  const std::int32_t *i, *j;
  std::int64_t count;
  std::int32_t* touching;  ///< null without history
  Vec3* slips;
  ContactParams params;
  double timestep;                   ///< 0 if contacts stay as they are
  bool advances;                     ///< whether they do not
  std::vector<GrainContact>* found;  ///< null if not wanted
};

}  // namespace dch::detail

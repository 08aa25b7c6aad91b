// SPDX-License-Identifier: MIT
#include "ReferenceNonbondedSum.h"

#include <dch/engines/pair_search.hpp>

namespace OpenMMDCH {
namespace {

// Of the cutoff: as much as OpenMM pads its own lists.
constexpr double kSkinFraction = 0.25;

}  // namespace

/// A list whose skin fits the box: as large as there is room, or near it, since boxes change all the time
/// under a barostat.
void ReferenceNonbondedSum::chooseList(double room) {
  if (list && skin <= room && skin >= 0.5 * room) return;
  skin = room;
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(potential().cutoffDistance());
  params.skin = skin;
  params.exclusions = &exclusions();
  list = std::make_unique<dch::VerletList>(dch::make_dch_search(params.list_radius()), params);
}

double ReferenceNonbondedSum::addPairs(const HostState& state, bool) {
  const double room =
      potential().hasCutoff() ? roomForSkin(potential().cutoffDistance(), kSkinFraction, state.box) : -1;
  if (room < 0) {
    checkPositions(state.positions);
    return addRows(state, 0, 1, state.forces);
  }
  chooseList(room);
  list->update(state.positions, state.box);
  double energy = 0;
  for (std::size_t i = 0; i < list->list().size(); ++i)
    for (const std::int32_t j : list->list().row(i))
      energy += addPair(state, i, static_cast<std::size_t>(j), state.forces);
  return energy;
}

}  // namespace OpenMMDCH

// SPDX-License-Identifier: MIT
#include "ContactKeeper.h"

#include <algorithm>
#include <utility>

#include "HostState.h"

namespace OpenMMDCH {
namespace {

dch::necklace::ContactFinderParams paramsFor(dch::Executor* threads) {
  dch::necklace::ContactFinderParams params;
  params.executor = threads;
  params.refuse_undetermined = true;  // chains of a simulation that has gone wrong
  return params;
}

// Of the largest sum of two radii. With more, searches are rarer and pairs between them are more: in a melt
// 0.3 to 0.45 are equally fast, 0.2 and 0.6 slower.
constexpr double kSkinFraction = 0.3;

}  // namespace

ContactKeeper::ContactKeeper(dch::necklace::Necklace necklace,
                             const dch::necklace::ContactQuery& contactQuery, dch::Executor* threads)
    : finder(std::move(necklace), paramsFor(threads)), query(contactQuery), beads(finder.necklace().size()) {}

/// As large as there is room, or near it, since boxes change all the time under a barostat.
void ContactKeeper::chooseSkin(const dch::Box& box) {
  const double room = std::max(0.0, roomForSkin(2 * necklace().largest_radius(), kSkinFraction, box));
  if (staleTest && skin <= room && skin >= 0.5 * room) return;
  skin = room;
  staleTest.emplace(skin);
}

dch::Span<const dch::IndexPair> ContactKeeper::at(dch::Span<const dch::Vec3> positions, const dch::Box& box) {
  chooseSkin(box);
  for (std::size_t place = 0; place < beads.size(); ++place)
    beads[place] = positions[static_cast<std::size_t>(necklace().particle()[place])];
  if (!staleTest->is_stale(beads, box)) return pairs;
  staleTest->forget();
  pairs.clear();
  for (const dch::necklace::Contact& contact : contacts(positions, box, skin))
    pairs.push_back({contact.i, contact.j});
  staleTest->remember(beads, box, 2 * necklace().largest_radius() + skin);
  return pairs;
}

std::vector<dch::necklace::Contact> ContactKeeper::contacts(dch::Span<const dch::Vec3> positions,
                                                            const dch::Box& box, double gap) {
  finder.update(positions, box);
  query.gap = gap;
  return finder.find_contacts(query);
}

}  // namespace OpenMMDCH

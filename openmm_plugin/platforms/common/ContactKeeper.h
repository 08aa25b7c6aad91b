// SPDX-License-Identifier: MIT
#ifndef OPENMM_DCH_CONTACT_KEEPER_H_
#define OPENMM_DCH_CONTACT_KEEPER_H_

#include <optional>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/lists/stale_test.hpp>
#include <dch/necklace/contact_finder.hpp>

namespace OpenMMDCH {

/// Keeps the pairs of beads that touch, and some that nearly do, complete while chains move and the box
/// changes. They are searched for when a pair might be missing, with the structure that suits the chains.
class ContactKeeper {
 public:
  /// @param query  its gap is not looked at
  /// @param threads  to search on; null for that of the caller alone. They outlive the object
  ContactKeeper(dch::necklace::Necklace necklace, const dch::necklace::ContactQuery& query,
                dch::Executor* threads);

  const dch::necklace::Necklace& necklace() const { return finder.necklace(); }
  /// What the next search is made with, and why.
  const dch::necklace::StructureChoice& choice() const { return finder.choice(); }

  /// Pairs of particles i < j in ascending order, all that touch among them.
  /// @throws dch::Error for positions that are not finite, a bond of half the box's height or more, a chain
  ///   that winds around the box, and a box too small for the radii
  dch::Span<const dch::IndexPair> at(dch::Span<const dch::Vec3> positions, const dch::Box& box);
  /// The pairs whose surfaces are at most `gap` apart, in that order.
  /// @throws dch::Error as at(), and for a gap that is not finite or too large for the box
  std::vector<dch::necklace::Contact> contacts(dch::Span<const dch::Vec3> positions, const dch::Box& box,
                                               double gap);

 private:
  void chooseSkin(const dch::Box& box);

  dch::necklace::ContactFinder finder;
  dch::necklace::ContactQuery query;
  double skin = 0;
  std::optional<dch::StaleTest> staleTest;
  std::vector<dch::Vec3> beads;  ///< by place
  std::vector<dch::IndexPair> pairs;
};

}  // namespace OpenMMDCH

#endif

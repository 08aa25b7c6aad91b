// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/vec3.hpp>
#include <dch/necklace/cage_hierarchy.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// Which pairs of beads are contacts.
struct ContactQuery {
  /// Pairs whose surfaces are at most this far apart [length]; below 0 it asks for overlap of at least -gap.
  double gap = 0;
  /// Pairs of one chain with this many bonds between them, around a ring the shorter way, and fewer are left
  /// out, >= 0: 1 leaves out bonded beads, 0 nothing.
  int skip_bonds = 1;
  bool within_chains = true;
  bool between_chains = true;
};

/// Two beads in contact.
struct Contact {
  std::int32_t i = 0, j = 0;  ///< particles, i < j
  double gap = 0;             ///< distance of the surfaces, below 0 if they overlap [length]
  Vec3 on_i, on_j;  ///< their closest points: on bead i where it is, and on the image of j nearest to it
};

/// What a search cost.
struct ContactStats {
  std::int64_t cage_pairs = 0;  ///< pairs of different cages compared: the visited pairs of Theorem 4.5.1
  std::int64_t bead_pairs = 0;  ///< pairs of beads compared one by one
};

/// Beads at consecutive places of one chain, and a ball that encloses them.
struct CagedBeads {
  std::int32_t first = 0, count = 0;  ///< places
  Ball cage;
};

/// Two cages whose distance is larger than the gap of a query in every image: no bead of one is in contact
/// with a bead of the other.
struct SeparatingPair {
  CagedBeads a, b;
};

/// A certificate of the answer: each pair of beads that the query asks for is either a contact or in exactly
/// one of the separating pairs (thesis 4.5.1).
struct Separation {
  std::vector<SeparatingPair> pairs;
  std::vector<Contact> contacts;
};

/// Whether there is any contact: the search ends at the first.
///
/// Cages are compared from the roots down; of two that are not apart the one with more beads is split. In a
/// periodic box the distance of cages is that of the nearest images, so cages may be larger than the box. The
/// pair distance of beads is Box::distance2 of the positions as given, and contacts are those with distance
/// <= r_i + r_j + gap.
///
/// Cost: of one chain without contact, O(n lg n) cage pairs in the plane and O(n^(4/3)) in space (Theorem
/// 4.5.1, corrected), if the radii and the bonds are bounded by constants from above and below and the
/// chain is connected; Necklace::measure() reports the constants. Packed chains and gaps much larger than
/// beads cost more. Between m chains, pairs of roots come from a cell list if the largest root allows it,
/// else all m^2/2 are looked at.
/// @param executor threads to search on; null for that of the caller alone. The answer and, where there is no
///   contact to end at, the stats do not depend on it.
/// @throws InvalidParameter for a gap that is not finite, skip_bonds < 0, and a hierarchy without positions;
///   CutoffTooLarge if twice the largest radius + gap exceeds box.max_cutoff(), so that a bead might touch
///   two images of another.
bool any_contact(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats = nullptr,
                 Executor* executor = nullptr);

/// All contacts, in ascending order of (i, j), each pair once. As any_contact().
std::vector<Contact> find_contacts(const CageHierarchy& hierarchy, const ContactQuery& query,
                                   ContactStats* stats = nullptr, Executor* executor = nullptr);

/// All contacts, with the separating family that shows that there are no others. As any_contact(), but all
/// pairs of roots are looked at, on one thread, and in a periodic box cages in all images: of cages whose
/// beads can be in contact in one image alone, parts may reach each other in another image.
Separation separate(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats = nullptr);

/// Checks a certificate against nothing but the beads of the hierarchy: each cage encloses its beads (within
/// 1e-11 of its radius), the cages of a pair are farther apart than the gap in every image, and each pair of
/// beads that the query asks for is covered exactly once. Returns an empty string, or what is wrong first.
/// O(n^2) time and n^2/8 bytes; for tests.
std::string check_certificate(const CageHierarchy& hierarchy, const ContactQuery& query,
                              const Separation& separation);

}  // namespace dch::necklace
#pragma GCC visibility pop

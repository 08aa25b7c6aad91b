// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/necklace.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// Separations along the chain that are next to each other, taken together.
struct SeparationRange {
  std::int32_t first = 0, last = 0;  ///< bonds between the beads, both included
  std::int64_t contacts = 0;         ///< over all frames
  std::int64_t pairs = 0;            ///< of beads, in one frame
  double probability = 0;            ///< contacts / (frames pairs)
};

/// P(s), the probability that two beads of one chain with s bonds between them, around a ring the shorter
/// way, are in contact: contacts at that separation over frames and pairs of beads.
///
/// An open chain of n beads has n - s pairs at separation s. A ring has n for s < n/2, n/2 at s = n/2, and no
/// farther ones. Chains of different lengths are summed up, so each pair has the same weight. Contacts
/// between chains do not count.
class ContactProbability {
 public:
  /// No separations.
  ContactProbability() = default;
  /// @param query what the contacts are found with: separations up to skip_bonds have no pairs, and none has
  ///   without within_chains
  /// @throws InvalidParameter for skip_bonds < 0.
  ContactProbability(const Necklace& necklace, const ContactQuery& query);

  /// Counts the contacts of one more frame. O(contacts).
  /// @throws InvalidParameter if a contact names a particle that is no bead; what stands before it is counted
  ///   then.
  void add(Span<const Contact> contacts);

  std::int64_t frames() const { return frames_; }  ///< taken so far
  /// By separation, from 0 to the largest in the chains: contacts over all frames.
  Span<const std::int64_t> contacts() const { return contacts_; }
  /// Likewise, pairs of beads that the query asks for, in one frame.
  Span<const std::int64_t> pairs() const { return pairs_; }
  /// P(s); NaN where there is no pair, and before the first frame.
  double probability(std::size_t separation) const;

  /// P(s) over ranges of separations that grow in proportion, for plots: each ends before 10^(1/per_decade)
  /// times its first separation, and holds one separation at least. Separations without pairs are left out.
  /// @throws InvalidParameter unless per_decade is 1 .. 1000.
  std::vector<SeparationRange> ranges(int per_decade) const;

 private:
  Necklace necklace_;
  std::vector<std::int32_t> place_;  ///< by particle
  std::vector<std::int64_t> contacts_, pairs_;
  std::int64_t frames_ = 0;
};

}  // namespace dch::necklace
#pragma GCC visibility pop

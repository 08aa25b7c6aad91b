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

/// How often beads were in contact, over the frames of a trajectory: a symmetric matrix over the beads in the
/// order of their places, or over bins of them where there are many, so that memory is bounded.
///
/// A bin is a range of places. If there are at most as many chains as bins, each chain is cut into bins of
/// its own, whose sizes differ by one at most; the largest size is the least that keeps to the number of
/// bins. Else a bin holds several whole chains.
class ContactMap {
 public:
  static constexpr std::int32_t kMaxBins = 1 << 14;
  /// The name of before, for one version.
  [[deprecated("it is kMaxBins now")]] static constexpr std::int32_t kMostBins = kMaxBins;

  /// No bins.
  ContactMap() = default;
  /// @param query what the contacts are found with: it says which pairs pairs() counts
  /// @param max_bins 1 .. kMaxBins; memory is 4 max_bins (max_bins + 1) bytes and 4 a particle
  /// @throws InvalidParameter for max_bins out of range, skip_bonds < 0.
  ContactMap(const Necklace& necklace, const ContactQuery& query, std::int32_t max_bins = 512);

  /// Counts the contacts of one more frame. O(contacts).
  /// @throws InvalidParameter if a contact names a particle that is no bead; what stands before it is counted
  ///   then.
  void add(Span<const Contact> contacts);

  std::int64_t frames() const { return frames_; }  ///< taken so far
  std::size_t bins() const { return bins_.size(); }
  /// Bin k holds the places first_place(k) .. first_place(k + 1) - 1; first_place(bins()) is their number.
  std::int32_t first_place(std::size_t bin) const { return bin < bins() ? bins_[bin].first : places_; }

  /// Contacts between a bead of bin a and one of bin b, each pair of beads once in each frame, over all
  /// frames.
  std::int64_t contacts(std::size_t a, std::size_t b) const { return count_[entry(a, b)]; }
  /// Pairs of a bead of bin a and one of bin b that the query asks for, in one frame.
  std::int64_t pairs(std::size_t a, std::size_t b) const;
  /// The part of these pairs that were in contact, as a mean over the frames: contacts / (frames pairs). NaN
  /// where the query asks for no pair, and before the first frame.
  double frequency(std::size_t a, std::size_t b) const;

 private:
  /// Beads at the places first .. last - 1. Where they are of one chain, it is the one of `size` beads from
  /// place `chain` on.
  struct Bin {
    std::int32_t first = 0, last = 0;
    std::int32_t chain = 0, size = 0;  ///< -1 and 0 for several chains
    bool closed = false;
    std::int64_t own_pairs = 0;  ///< that the query asks for
  };

  void cut_chains(const Necklace& necklace, std::int32_t max_bins);
  void gather_chains(const Necklace& necklace, std::int32_t max_bins);
  static std::size_t entry(std::size_t a, std::size_t b) {
    return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b;
  }

  ContactQuery query_;
  std::vector<Bin> bins_;
  std::vector<std::int32_t> place_, bin_;  ///< by particle; by place
  std::vector<std::int64_t> count_;        ///< lower triangle
  std::int32_t places_ = 0;
  std::int64_t frames_ = 0;
};

}  // namespace dch::necklace
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/neighbor_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// A cutoff for each pair of particle types.
class TypeCutoffs {
 public:
  /// One type for all: a single cutoff [length].
  explicit TypeCutoffs(double cutoff);
  /// Symmetric matrix of cutoffs, row-major, types x types [length]. A cutoff of 0 drops the pair altogether.
  /// @throws InvalidParameter if it is not square, not symmetric, or holds a negative or non-finite entry, or
  /// only 0.
  TypeCutoffs(int types, std::vector<double> matrix);

  int types() const { return types_; }
  double operator()(int a, int b) const {
    return matrix_[static_cast<std::size_t>(a) * static_cast<std::size_t>(types_) +
                   static_cast<std::size_t>(b)];
  }
  double largest() const { return largest_; }

  friend bool operator==(const TypeCutoffs& a, const TypeCutoffs& b) { return a.matrix_ == b.matrix_; }
  friend bool operator!=(const TypeCutoffs& a, const TypeCutoffs& b) { return !(a == b); }

 private:
  int types_ = 1;
  std::vector<double> matrix_;
  double largest_ = 0;
};

/// A host's own decision about pairs that are as far apart as their cutoff, to within rounding: for hosts
/// that compute distances otherwise than ListParams says, from images of particles that they made themselves.
class TieBreaker {
 public:
  /// @param error how far the distance of the host may be from the pair distance at most [length]
  explicit TieBreaker(double error) : error_(error) {}
  virtual ~TieBreaker() = default;

  /// Whether the pair of these particles is within its cutoff + skin. Asked from all threads of a list's
  /// executor, about pairs whose pair distance is within error() of that, and maybe about others nearby,
  /// where the answer has to be that of the pair distance.
  virtual bool accepts(std::int32_t i, std::int32_t j) const = 0;
  double error() const { return error_; }

 protected:
  TieBreaker(const TieBreaker&) = default;
  TieBreaker& operator=(const TieBreaker&) = default;

 private:
  double error_;
};
using PairTest = TieBreaker;  ///< the name of before, for one version

/// What a list has to hold.
///
/// The pair distance of i < j is |(x_j - x_i) + n_a a + n_b b + n_c c| with the integers of the nearest
/// image, evaluated in double from the positions and the cell vectors as given, in this order; a pair is in
/// the list iff its square is <= (cutoff + skin)^2 (at half a period, where two images are equally near, for
/// either of them). Every engine uses this definition, so ties at the cutoff come out alike.
struct ListParams {
  TypeCutoffs cutoffs{1.0};
  double skin = 0;  ///< r_s >= 0 [length], added to every non-zero cutoff; the list is stale once an atom
                    ///< moved more than r_s/2
  ListKind kind = ListKind::half;
  RowOrder order = RowOrder::by_index;
  /// Radii r_i >= 0 of the particles [length], at least one of them > 0; if given, the cutoff of a pair is
  /// r_i + r_j, and `cutoffs` and `types` are not looked at.
  Span<const double> radii{};
  Span<const std::int32_t> types{};  ///< one per particle in [0, cutoffs.types()); may be empty for one type
  const Exclusions* exclusions = nullptr;  ///< pairs left out; not owned, may be null
  /// Particles from this index on are ghosts: pairs of two ghosts are left out, and the rows of ghosts are
  /// empty in full lists and in unsorted ones. Negative: there are none.
  std::int32_t first_ghost = -1;

  /// >= 0; where cutoffs go by radii, not more than the skin [length]. In unsorted lists, neighbors that
  /// are farther than their cutoff + skin less this come last in their row (NeighborList::near_end); 0 for no
  /// such order. With shell = skin, neighbors inside the cutoff come first in each row, so the branch of a
  /// force loop predicts well. Squared distances are rounded for this, by up to 2/1000 of that of the list
  /// radius; more than 16 types go by the largest cutoff; and where the list radius reaches half the box, all
  /// count as nearer.
  double shell = 0;

  /// Whether pairs a little farther apart than their cutoff + skin may be listed too, none being left out:
  /// cheaper, for callers that test the distance anyway. NeighborList::margin says how much farther.
  bool superset = false;

  /// Decides in place of the pair distance where the cutoff is near; not owned, may be null. Its error counts
  /// with list_radius() as to what radius an engine has to be made for.
  const TieBreaker* tie_breaker = nullptr;

  /// Error of tie_breaker, 0 if there is none [length].
  double cutoff_error() const { return tie_breaker != nullptr ? tie_breaker->error() : 0; }

  /// Largest cutoff plus skin: r_list. O(n) where there are radii.
  double list_radius() const;
};

/// The smallest and the largest radius of particles, for who asks about lists again and again [length].
struct RadiusRange {
  RadiusRange() = default;
  /// O(n); zeros if there are no radii.
  explicit RadiusRange(Span<const double> radii);

  double least = 0, largest = 0;
};

}  // namespace dch
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// What neighbor_pairs() has to find.
struct NeighborPairsParams {
  TypeCutoffs cutoffs{1.0};          ///< [length]
  double skin = 0;                   ///< r_s >= 0 [length], added to every non-zero cutoff
  Span<const double> radii{};        ///< if given, the cutoff of a pair is r_i + r_j, see ListParams::radii
  Span<const std::int32_t> types{};  ///< see ListParams::types
  /// full: each pair in the rows of both particles. half: in the row of the smaller index; of the two pairs
  /// of a particle and its own images by S and -S, the one whose first non-zero number is positive.
  ListKind kind = ListKind::full;
  /// Pairs left out, in every image; those of a particle and its own images stay. Not owned, may be null.
  const Exclusions* exclusions = nullptr;
  Executor* executor = nullptr;  ///< threads; null for that of the caller alone. Results do not depend on it.
  /// More pairs, or images of particles, than this are refused before memory is taken for them.
  std::int64_t max_pairs = std::numeric_limits<std::int64_t>::max();
};

/// The expected number of pairs, or that of images of particles, exceeds NeighborPairsParams::max_pairs.
class TooManyPairs : public Error {
 public:
  using Error::Error;
};

/// All pairs of particles within their cutoff, over all images of the periodic cell, so at any ratio of the
/// cutoff to the cell.
///
/// The pair (i, j, S), S three integers, is the particle i and the image of j whose displacement is
///     D = x_j - x_i + S_0 a + S_1 b + S_2 c,
/// with positions and cell vectors as given; it is listed iff |D| <= cutoff + skin, D evaluated in double in
/// this order. S is 0 along open axes. Particles may lie anywhere outside the cell. A particle's own images
/// are listed, itself with S = 0 is not.
class NeighborPairs {
 public:
  using Shift = std::array<std::int32_t, 3>;

  std::size_t particles() const { return home_.size(); }
  /// Number of listed pairs: those within cutoff + skin.
  std::int64_t listed() const { return first_.back(); }
  std::int64_t listed_in_row(std::int32_t i) const {
    return first_[static_cast<std::size_t>(i) + 1] - first_[static_cast<std::size_t>(i)];
  }
  /// Whether pairs farther apart than their cutoff are listed.
  bool has_skin() const { return has_skin_; }

  /// Takes later positions, for shifts as they are now: particles may have been wrapped into the cell, or out
  /// of it, since. Without this displacements of positions at other times have no meaning. O(n).
  /// @param box as before, or changed as StaleTest allows
  /// @throws InvalidPosition; InvalidParameter for another number of positions or another periodicity.
  ///   Nothing changes then.
  void follow(Span<const Vec3> positions, const Box& box);

  /// Whether a change of the box may be followed as StaleTest allows: where no particle has two images within
  /// cutoff + skin of another one. Elsewhere any change of the box needs pairs found anew.
  bool may_change_box() const { return may_change_box_; }

  /// Which pairs are meant.
  enum class Within { cutoff, cutoff_and_skin };

  /// Calls f(j, S, D) for the pairs of particle i that are within their cutoff at these positions, or for all
  /// that are listed: the positions are those found, or those of the last follow(). Rows may be asked for by
  /// several threads at once.
  template <class F>
  void for_each_in_row(std::int32_t i, Span<const Vec3> positions, const F& f,
                       Within within = Within::cutoff) const {
    const bool is_tested = has_skin_ && within == Within::cutoff;
    const auto row = static_cast<std::size_t>(i);
    const Vec3 from = positions[row];
    const Shift home = home_[row];
    const auto last = static_cast<std::size_t>(first_[row + 1]);
    for (auto k = static_cast<std::size_t>(first_[row]); k < last; ++k) {
      const auto j = static_cast<std::size_t>(j_[k]);
      const Shift &image = images_[image_[k]], &other = home_[j];
      const Shift s{image[0] + other[0] - home[0], image[1] + other[1] - home[1],
                    image[2] + other[2] - home[2]};
      const Vec3 d = displacement(positions[j] - from, s);
      if (!is_tested || norm2(d) <= cutoff2(row, j)) f(j_[k], s, d);
    }
  }

 private:
  friend class NeighborPairsMaker;

  Vec3 displacement(Vec3 d, const Shift& s) const {
    if ((s[0] | s[1] | s[2]) == 0) return d;
    return ((d + static_cast<double>(s[0]) * cell_[0]) + static_cast<double>(s[1]) * cell_[1]) +
           static_cast<double>(s[2]) * cell_[2];
  }
  double cutoff2(std::size_t i, std::size_t j) const {
    const double cutoff = !radii_.empty()  ? radii_[i] + radii_[j]
                          : types_.empty() ? cutoffs_.largest()
                                           : cutoffs_(types_[i], types_[j]);
    return cutoff * cutoff;
  }

  std::vector<std::int64_t> first_{0};  ///< row i is j_[first_[i]] .. j_[first_[i+1]-1]
  std::vector<std::int32_t> j_;
  std::vector<std::uint32_t> image_;  ///< of j, beside the home images of both
  std::vector<Shift> images_;
  std::vector<Shift> home_;     ///< what brings each particle next to its place in home_positions_
  std::array<Vec3, 3> cell_{};  ///< as given, 0 along open axes
  bool has_skin_ = false, may_change_box_ = false;
  TypeCutoffs cutoffs_{1.0};
  std::vector<std::int32_t> types_;
  std::vector<double> radii_;
  std::vector<Vec3> home_positions_;  ///< in the reduced cell, when pairs were found; kept for a skin
  Box box_;
};

/// Finds all pairs over all images. Where cutoff + skin is below half the smallest height of the cell, an
/// engine finds them in the periodic box; else in open space among the particles and their images that are
/// near enough, as ghosts. O(n + pairs) at bounded density. Neighbors come in an order that is the same on
/// any number of threads and any instruction set.
/// @throws InvalidPosition, also for particles more than 2^29 periods away from the cell; TooManyPairs;
///   InvalidParameter for a negative or non-finite skin, types, radii or exclusions that do not fit, and a
///   cutoff + skin outside kMinListRadius..kMaxListRadius. `out` is then empty or as it was.
void neighbor_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params,
                    NeighborPairs& out);
NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params);
/// About how many pairs there are, by the rows of eight particles: quick, and right where all particles have
/// about as many neighbors. O(n).
/// @throws as neighbor_pairs()
double expected_pairs(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params);

/// All pairs within one cutoff [length].
NeighborPairs neighbor_pairs(Span<const Vec3> positions, const Box& box, double cutoff);

}  // namespace dch
#pragma GCC visibility pop

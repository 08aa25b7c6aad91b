// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Coordinates (or forces) of the four slots of a cluster, side by side as vector registers want them.
template <class Real>
struct ClusterOfFour;
template <>
struct alignas(32) ClusterOfFour<double> {
  double x[4]{}, y[4]{}, z[4]{};
};
template <>
struct alignas(64) ClusterOfFour<float> {
  float x[4]{}, y[4]{}, z[4]{};
  float filling[4]{};  ///< of a register; 0
};

/// Coordinates in integer multiples of ClusterPairs::unit, modulo 2^32.
struct alignas(64) ClusterUnits {
  std::int32_t x[4]{}, y[4]{}, z[4]{};
};
/// Where the slots of a cluster are, in a kernel of that precision.
template <class Real>
using ClusterPlace = std::conditional_t<std::is_same_v<Real, float>, ClusterUnits, ClusterOfFour<Real>>;

/// What a kernel of that precision adds to places in an entry's cluster J.
template <class Real>
struct ClusterShift;
template <>
struct ClusterShift<double> {
  ClusterOfFour<double> whole;  ///< the same for all four slots
};
/// The vector of an image, in units, modulo 2^32.
template <>
struct alignas(16) ClusterShift<float> {
  std::int32_t axis[4]{};  ///< the fourth is 0
};

/// Pairs of clusters of four particles: what a SIMD force kernel reads in place of a neighbor list.
///
/// Every pair of particles that the ListParams ask for stands in one entry, once (twice if two of its images
/// are exactly half a period away, both at the list radius). Masks hold a few pairs more, a little farther
/// apart than the list radius: a force kernel tests its cutoff. Particles with no other one near may stand in
/// no slot.
/// Hierarchy::cluster_pairs() makes them.
///
/// Particles are held relative to an origin near them (a node of level 1). The displacement from slot a of
/// cluster I to slot b of cluster J of an entry is (at[J][b] + shift) - at[I][a], with the shift that the
/// entry names; it leads to the one image of the particle that is meant, and needs no box. In single
/// precision, coordinates are integer multiples of `unit`, a power of two, from the origin of all coordinates
/// on and modulo 2^32. So the displacement, which is far below 2^31 units, is
///     unit x float((at_in_units[J][b] + shift_in_units) - at_in_units[I][a])
/// where integers are added and subtracted exactly, however far from the origin particles are.
struct ClusterPairs {
  static constexpr int kSlots = 4;  ///< in a cluster

  /// A cluster J beside the cluster I of its row.
  struct Entry {
    std::int32_t cluster;
    std::uint16_t mask;   ///< bit 4 a + b: slot a of I and slot b of J are a pair; never 0
    std::uint16_t shift;  ///< counted from the row's first one
  };
  /// Entries entries[first] .. entries[(next row's first) - 1] of cluster I, one at least. A cluster has one
  /// row or none; more where one row cannot name all its shifts, and where entries are joined.
  struct Row {
    std::int64_t first;
    std::int32_t cluster;
    std::int32_t first_shift;
  };
  /// A lattice vector, in integer multiples of the cell vectors as given, from one origin to another.
  struct Shift {
    std::int32_t from, to;
    Vec3 image;
  };

  std::vector<Row> rows;  ///< and one more with the number of entries
  std::vector<Entry> entries;

  /// How the entries of a row stand.
  enum class EntryOrder {
    as_found,
    /// First those with pairs of slots 0 or 1 of I and of slots 2 or 3, then those with pairs of slots 0 and
    /// 1 alone, then those with pairs of slots 2 and 3 alone.
    by_halves,
    /// The same, and all entries of a row are of one image: in single precision no cluster J has to be moved.
    by_image_and_halves,
    /// First those that stand alone, then two by two those that have no bit of their masks in common: a
    /// register of 16 pairs holds both. All entries of a row are of one image.
    joined
  };
  /// Of the entries of a row, in another order than as_found.
  struct RowParts {
    std::int32_t first;  ///< with pairs of both halves, or alone
    std::int32_t lower;  ///< the same and those of slots 0 and 1; not of entries that are joined
  };
  EntryOrder entry_order = EntryOrder::as_found;
  std::vector<RowParts> parts;  ///< by row, in another order than as_found

  int refreshes = 0;         ///< since the search
  int refreshes_before = 0;  ///< between the two last searches into this

  /// Clusters whose rows a force kernel computes on one thread. Rows name clusters of their own task and of
  /// later ones. Tasks depend on the clusters alone, so forces that are summed up in their order do not
  /// depend on the number of threads.
  struct Task {
    std::int32_t first_cluster;
    std::int64_t first_range;
  };
  /// Clusters `first` .. `last` - 1.
  struct Range {
    std::int32_t first, last;
  };
  std::vector<Task> tasks;    ///< and one more, for the end of the last
  std::vector<Range> ranges;  ///< by task: those of later tasks that its rows name, and a few more; ascending
  std::vector<std::uint8_t>
      has_earlier_contributions;  ///< by origin: whether ranges of earlier tasks hold its clusters

  std::vector<std::int32_t> particle;   ///< by slot; -1 for padding
  std::vector<std::int32_t> type;       ///< by slot, of ListParams::types; 0 without those and for padding
  std::vector<std::int32_t> origin_of;  ///< by cluster
  std::vector<Vec3> origin;             ///< [length]
  std::vector<Shift> shift;

  // What refresh() writes. Padding stands where the first particle of its cluster does.
  std::vector<ClusterOfFour<double>> at;           ///< by cluster, relative to its origin [length]
  std::vector<ClusterUnits> at_in_units;           ///< by cluster
  std::vector<ClusterShift<double>> shift_vector;  ///< by shift, from one origin to another [length]
  std::vector<ClusterShift<float>> shift_in_units;
  bool has_shift_vectors = false;     ///< of `box`; not so after a search
  std::vector<Vec3> origin_in_units;  ///< modulo 2^32, and 1.5 x 2^52: a sum's last bits are an integer
  double unit = 1;                    ///< of places in single precision, a power of two [length]
  double farthest = 0;                ///< no particle is as far from its origin [length]

  /// A cluster whose particles lay in different periodic images at the last refresh().
  struct SplitCluster {
    std::int32_t cluster;
    Vec3 image[kSlots];  ///< in integer multiples of the cell vectors, to be added to each
  };
  std::vector<SplitCluster>
      split_clusters;  ///< by ascending cluster; what refresh() remembers from one time to the next

  std::size_t particles = 0;  ///< number of positions
  int types = 1;              ///< of ListParams::cutoffs
  double list_radius = 1;     ///< of the ListParams [length]
  Box box;

  /// Where the rows of a task begin; those of a cluster stand behind those of the clusters before it.
  std::size_t first_row(const Task& task) const {
    const auto end = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() - 1);
    return static_cast<std::size_t>(
        std::lower_bound(rows.begin(), end, task.first_cluster,
                         [](const Row& row, std::int32_t cluster) { return row.cluster < cluster; }) -
        rows.begin());
  }
  std::int32_t clusters() const { return static_cast<std::int32_t>(origin_of.size()); }
  /// Number of pairs of slots in all masks.
  std::int64_t slot_pairs() const;

  /// Calls f(i, j, displacement from i to j) for every pair in the masks, in double.
  template <class F>
  void for_each(const F& f) const {
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
      const auto i = static_cast<std::size_t>(rows[r].cluster);
      for (std::int64_t e = rows[r].first; e < rows[r + 1].first; ++e) {
        const Entry& entry = entries[static_cast<std::size_t>(e)];
        const auto j = static_cast<std::size_t>(entry.cluster);
        const auto& by = shift_vector[static_cast<std::size_t>(rows[r].first_shift) + entry.shift].whole;
        for (std::size_t bit = 0; bit < kSlots * kSlots; ++bit) {
          if ((entry.mask >> bit & 1) == 0) continue;
          const std::size_t a = bit / kSlots, b = bit % kSlots;
          f(particle[kSlots * i + a], particle[kSlots * j + b],
            Vec3{at[j].x[b] + by.x[b] - at[i].x[a], at[j].y[b] + by.y[b] - at[i].y[a],
                 at[j].z[b] + by.z[b] - at[i].z[a]});
        }
      }
    }
  }

  /// Takes new positions of the same particles, indexed as before, without a new search. They may be wrapped
  /// into the cell or not, and the cell may have changed its shape (not its periodicity); each particle is
  /// taken to have moved less than half the smallest height since the last time. The pairs stay complete as
  /// long as StaleTest's condition holds. O(n), a few nanoseconds a particle.
  /// @throws InvalidParameter for another number of positions, InvalidBox for another periodicity,
  ///   InvalidPosition for a coordinate that is not finite. After a throw the positions are of no time; the
  ///   next ones may be taken all the same.
  /// @param executor threads to do it with; null for that of the caller
  void refresh(Span<const Vec3> positions, const Box& now, Executor* executor = nullptr);

  /// Where particles were when their pairs were found, and the lattice vectors that bring them there.
  struct Places {
    std::vector<ClusterOfFour<double>> at;     ///< `at` of then
    std::vector<std::int32_t> shift_of;        ///< by cluster, into `shift`; -1 where nothing is shifted
    std::vector<ClusterOfFour<double>> shift;  ///< to be added to positions [length]
  };
  /// refresh() in the box of the search, as it is now again, with the question who has moved far, in one
  /// pass. Positions of particles that are in another image than `places` says are no place: they come out
  /// uncertain.
  /// @param within  from its place, for a particle not to be asked about [length]
  /// @param away  gets the clusters of which one is farther, ascending
  /// @return false if the image of a particle is uncertain, as it is a quarter of the smallest height from
  ///   its place, or if it is farther from its origin than `farthest` or nowhere finite: then some positions
  ///   are of an earlier time, and refresh() has to take all
  bool follow(const Places& places, Span<const Vec3> positions, const Box& now, double within,
              std::vector<std::int32_t>& away, Executor* executor = nullptr);

  /// Puts the entries of each row in the order that a kernel is faster with
  /// (LennardJones::wanted_order()); all kernels take any. Masks may lose pairs later, rows must not lose
  /// entries then. Does nothing if positions were taken less than steps_to_order() times between the two last
  /// searches, as it would not pay, or if there is an order already. O(entries). After a throw the order is
  /// said to be as_found.
  void order_entries(EntryOrder wanted, Executor* executor = nullptr);
  /// How often positions have to be taken between two searches for an order to pay.
  static constexpr int steps_to_order(EntryOrder order) { return order == EntryOrder::joined ? 10 : 3; }

  std::size_t memory_bytes() const;

 private:
  void refresh_clusters(Span<const Vec3> positions, const Box& now, Executor* executor);
  void refresh_split(const std::vector<std::int32_t>& split, Span<const Vec3> positions, const Box& now,
                     Executor* executor);
  void take_box(const Box& now, Executor* executor);
  void refresh_shifts(const Box& now, Executor* executor);
  void choose_unit(const Box& now, Executor* executor);
  void make_room_for(double farthest2, const Box& now, Executor* executor);
};

}  // namespace dch
#pragma GCC visibility pop

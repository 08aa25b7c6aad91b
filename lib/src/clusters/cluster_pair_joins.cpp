// SPDX-License-Identifier: MIT
//
// ClusterPairs: entries that fill a register together.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch {
namespace {

constexpr int kPairsOfEntry = ClusterPairs::kSlots * ClusterPairs::kSlots;
constexpr std::uint16_t kAllPairs = 0xFFFF;
/// Times that positions are taken between two searches from which on joining entries is worth its time.
constexpr int kStepsToJoin = 5;
/// Entries that one is compared with, at most: so the work of a row is linear in it.
constexpr std::int32_t kJoinTries = 32;
/// Squared distances in single precision and coordinates in units are less off than that.
constexpr double kJoinSlack = 1e-5;

/// Joins the entries of one row after another.
class EntryJoiner {
 public:
  EntryJoiner(const ClusterPairs& pairs, const detail::NearSlotsTask& task)
      : pairs_(pairs),
        task_(task),
        near_slots_(detail::cluster_search_kernels(instruction_set()).near_slots) {}

  /// Puts the entries of row r in order. Returns how many stand alone.
  std::int32_t join(std::size_t r, ClusterPairs::Entry* entries, std::uint16_t* of_second) {
    const ClusterPairs::Row& row = pairs_.rows[r];
    const auto count = static_cast<std::int32_t>(pairs_.rows[r + 1].first - row.first);
    found_.resize(static_cast<std::size_t>(count));
    near_.resize(static_cast<std::size_t>(count));
    near_slots_(task_, row, count, near_.data());
    for (std::int32_t n = 0; n < count; ++n) {
      const ClusterPairs::Entry& entry = entries[row.first + n];
      found_[static_cast<std::size_t>(n)] = {entry, near_[static_cast<std::size_t>(n)], image_of(row, entry)};
    }
    alone_.clear();
    joined_.clear();
    const auto whole = std::stable_partition(
        found_.begin(), found_.end(), [](const Found& found) { return found.entry.mask != kAllPairs; });
    for (auto found = found_.begin(); found != whole; ++found) alone_.push_back(found->entry);
    for (auto first = whole; first != found_.end();) {
      const std::array<std::int32_t, 3> image = first->image;
      const auto last = std::stable_partition(first, found_.end(),
                                              [&](const Found& found) { return found.image == image; });
      join_of_image(&*first, static_cast<std::int32_t>(last - first));
      first = last;
    }
    ClusterPairs::Entry* to = std::copy(alone_.begin(), alone_.end(), entries + row.first);
    for (const auto& [first, second, mask] : joined_) {
      of_second[(to - entries) / 2] = mask;
      *to++ = first;
      *to++ = second;
    }
    return static_cast<std::int32_t>(alone_.size());
  }

 private:
  struct Found {
    ClusterPairs::Entry entry;
    std::uint16_t near;  ///< bits of the pairs within the list radius
    std::array<std::int32_t, 3> image;
  };
  struct Joined {
    ClusterPairs::Entry first, second;
    std::uint16_t of_second;
  };

  std::array<std::int32_t, 3> image_of(const ClusterPairs::Row& row, const ClusterPairs::Entry& entry) const {
    const auto& by = pairs_.shift_in_units[static_cast<std::size_t>(row.first_shift) + entry.shift];
    return {by.axis[0], by.axis[1], by.axis[2]};
  }

  /// Those with most pairs first, each with the fullest one that has pairs where it has none.
  void join_of_image(const Found* found, std::int32_t count) {
    std::array<std::int32_t, kPairsOfEntry + 2> next{};  // by pairs that an entry lacks
    for (std::int32_t n = 0; n < count; ++n) ++next[static_cast<std::size_t>(lacks(found[n]) + 1)];
    for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
    const std::array<std::int32_t, kPairsOfEntry + 2> begin = next;
    order_.resize(static_cast<std::size_t>(count));
    for (std::int32_t n = 0; n < count; ++n)
      order_[static_cast<std::size_t>(next[static_cast<std::size_t>(lacks(found[n]))]++)] = n;
    for (std::int32_t a = 0; a < count; ++a) {
      const std::int32_t first = order_[static_cast<std::size_t>(a)];
      if (first < 0) continue;
      // What has more pairs than the first one lacks does not fit.
      const std::int32_t from =
          std::max(a + 1, begin[static_cast<std::size_t>(kPairsOfEntry - lacks(found[first]))]);
      const std::int32_t to = std::min(count, from + kJoinTries);
      std::int32_t b = from;
      while (b < to && !fits(found, first, order_[static_cast<std::size_t>(b)])) ++b;
      if (b < to) {
        const std::int32_t second = std::exchange(order_[static_cast<std::size_t>(b)], -1);
        joined_.push_back({found[first].entry, found[second].entry, found[second].near});
      } else {
        alone_.push_back(found[first].entry);
      }
    }
  }
  static std::int32_t lacks(const Found& found) { return kPairsOfEntry - __builtin_popcount(found.near); }
  static bool fits(const Found* found, std::int32_t first, std::int32_t second) {
    return second >= 0 && (found[first].near & found[second].near) == 0;
  }

  const ClusterPairs& pairs_;
  const detail::NearSlotsTask& task_;
  void (*near_slots_)(const detail::NearSlotsTask&, const ClusterPairs::Row&, std::int32_t, std::uint16_t*);
  std::vector<Found> found_;
  std::vector<std::uint16_t> near_;
  std::vector<ClusterPairs::Entry> alone_;
  std::vector<Joined> joined_;
  std::vector<std::int32_t> order_;
};

}  // namespace

void ClusterPairs::join_entries(Executor* executor) {
  if (refreshes > 0)
    throw InvalidParameter("join_entries() was called after refresh() had been called " +
                           std::to_string(refreshes) +
                           " times; call it after a search, before positions are taken");
  if (refreshes_before < kStepsToJoin || !alone.empty() || rows.empty()) return;
  alone.resize(rows.size() - 1);
  of_second.resize(entries.size() / 2 + 1);
  const double limit = list_radius / unit;
  const detail::NearSlotsTask task{entries.data(), at_in_units.data(), shift_in_units.data(),
                                   static_cast<float>(limit * limit * (1 + kJoinSlack))};
  for_ranges(executor, static_cast<std::int32_t>(alone.size()), [&](std::int32_t first, std::int32_t last) {
    EntryJoiner joiner(*this, task);
    for (std::int32_t r = first; r < last; ++r)
      alone[static_cast<std::size_t>(r)] =
          joiner.join(static_cast<std::size_t>(r), entries.data(), of_second.data());
  });
}

}  // namespace dch

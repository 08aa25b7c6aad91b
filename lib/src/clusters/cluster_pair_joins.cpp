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
/// Times that positions are taken between two searches from which on joining entries is worth its time, which
/// is that of some 23 times what a step gains: see docs/engine.md.
constexpr int kStepsToJoin = 30;
/// Entries that one is compared with, at most: so the work of a row is linear in it.
constexpr std::size_t kJoinTries = 32;
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
    near_.resize(static_cast<std::size_t>(count));
    near_slots_(task_, row, count, near_.data());
    from_ = entries + row.first;
    alone_.clear();
    joined_.clear();
    rest_.clear();
    for (std::int32_t n = 0; n < count; ++n)
      if (from_[n].mask == kAllPairs)
        rest_.push_back(n);
      else
        alone_.push_back(from_[n]);
    while (!rest_.empty()) {
      const Image image = image_of(row, from_[rest_.front()]);
      same_.clear();
      std::size_t others = 0;
      for (const std::int32_t n : rest_)
        if (image_of(row, from_[n]) == image)
          same_.push_back(n);
        else
          rest_[others++] = n;
      rest_.resize(others);
      join_of_image();
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
  using Image = std::array<std::int32_t, 3>;
  struct Joined {
    ClusterPairs::Entry first, second;
    std::uint16_t of_second;
  };

  Image image_of(const ClusterPairs::Row& row, const ClusterPairs::Entry& entry) const {
    const auto& by = pairs_.shift_in_units[static_cast<std::size_t>(row.first_shift) + entry.shift];
    return {by.axis[0], by.axis[1], by.axis[2]};
  }

  /// Of same_: those with most pairs first, each with the fullest one that has pairs where it has none.
  void join_of_image() {
    const auto count = static_cast<std::int32_t>(same_.size());
    std::array<std::int32_t, kPairsOfEntry + 2> next{};  // by pairs that an entry lacks
    for (const std::int32_t n : same_) ++next[lacks(near_[static_cast<std::size_t>(n)]) + 1];
    for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
    const std::array<std::int32_t, kPairsOfEntry + 2> begin = next;
    sorted_.resize(same_.size());
    mask_.resize(same_.size());
    for (const std::int32_t n : same_) {
      const std::uint16_t near = near_[static_cast<std::size_t>(n)];
      const auto place = static_cast<std::size_t>(next[lacks(near)]++);
      sorted_[place] = n;
      mask_[place] = near;
    }
    is_taken_.assign(same_.size(), 0);
    for (std::int32_t a = 0; a < count; ++a) {
      const auto at = static_cast<std::size_t>(a);
      if (is_taken_[at] != 0) continue;
      const std::uint16_t near = mask_[at];
      // What has more pairs than the first one lacks does not fit.
      const auto lack = static_cast<std::size_t>(kPairsOfEntry) - lacks(near);
      auto b = static_cast<std::size_t>(std::max(a + 1, begin[lack]));
      const std::size_t to = std::min(same_.size(), b + kJoinTries);
      while (b < to && ((near & mask_[b]) | is_taken_[b]) != 0) ++b;
      if (b < to) {
        is_taken_[b] = 1;
        joined_.push_back({from_[sorted_[at]], from_[sorted_[b]], mask_[b]});
      } else {
        alone_.push_back(from_[sorted_[at]]);
      }
    }
  }
  static std::size_t lacks(std::uint16_t near) {
    return static_cast<std::size_t>(kPairsOfEntry - __builtin_popcount(near));
  }

  const ClusterPairs& pairs_;
  const detail::NearSlotsTask& task_;
  void (*near_slots_)(const detail::NearSlotsTask&, const ClusterPairs::Row&, std::int32_t, std::uint16_t*);
  const ClusterPairs::Entry* from_ = nullptr;
  std::vector<std::uint16_t> near_, mask_;
  std::vector<std::int32_t> rest_, same_, sorted_;
  std::vector<std::uint8_t> is_taken_;
  std::vector<ClusterPairs::Entry> alone_;
  std::vector<Joined> joined_;
};

}  // namespace

void ClusterPairs::join_entries(Executor* executor) {
  if (refreshes > 0)
    throw InvalidParameter("join_entries() was called after refresh() had been called " +
                           std::to_string(refreshes) +
                           " times; call it after a search, before positions are taken");
  if (refreshes_before < kStepsToJoin || !alone.empty() || rows.empty()) return;
  std::vector<std::int32_t> by_row(rows.size() -
                                   1);  // taken when all are done: memory may be lacking meanwhile
  of_second.resize(entries.size() / 2 + 1);
  const double limit = list_radius / unit;
  const detail::NearSlotsTask task{entries.data(), at_in_units.data(), shift_in_units.data(),
                                   static_cast<float>(limit * limit * (1 + kJoinSlack))};
  for_ranges(executor, static_cast<std::int32_t>(by_row.size()), [&](std::int32_t first, std::int32_t last) {
    EntryJoiner joiner(*this, task);
    for (std::int32_t r = first; r < last; ++r)
      by_row[static_cast<std::size_t>(r)] =
          joiner.join(static_cast<std::size_t>(r), entries.data(), of_second.data());
  });
  alone = std::move(by_row);
}

}  // namespace dch

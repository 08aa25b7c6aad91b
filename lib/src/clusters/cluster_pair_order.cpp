// SPDX-License-Identifier: MIT
//
// ClusterPairs: entries in the order that kernels are faster with.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <dch/base/instruction_set.hpp>
#include <dch/clusters/cluster_pairs.hpp>

#include "clusters/simd/cluster_search_kernels.hpp"

namespace dch {
namespace {

/// Slices of the work for each thread, so that none waits long for the last one.
constexpr int kOrderSlicesPerThread = 4;

using EntryOrder = ClusterPairs::EntryOrder;

/// An image, as one number.
using ImageKey = std::int64_t;

std::vector<ImageKey> keys_of_images(const std::vector<ClusterPairs::Shift>& shifts) {
  std::vector<ImageKey> keys;
  keys.reserve(shifts.size());
  constexpr ImageKey kBits = 21, kBelow = ImageKey{1} << kBits;
  for (const ClusterPairs::Shift& shift : shifts) {
    ImageKey key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << kBits | (static_cast<ImageKey>(std::llround(shift.image[axis])) & (kBelow - 1));
    keys.push_back(key);
  }
  return keys;
}

/// Puts rows in order, one after another.
class RowOrderer {
 public:
  RowOrderer(const ClusterPairs& pairs, const std::vector<ImageKey>& image_of_shift)
      : pairs_(pairs),
        image_of_shift_(image_of_shift),
        kernels_(detail::cluster_search_kernels(instruction_set())) {}

  void order(std::size_t r, EntryOrder wanted, ClusterPairs::Entry* entries) {
    const ClusterPairs::Row& row = pairs_.rows[r];
    ClusterPairs::Entry* to = entries + row.first;
    ClusterPairs::Entry* const end = entries + pairs_.rows[r + 1].first;
    make_room(static_cast<std::size_t>(end - to) + detail::kEntriesAtOnce);
    const bool stays_whole = wanted == EntryOrder::by_halves || all_of_one_image(row.first_shift);
    while (to != end) {
      ClusterPairs::Entry* const image_ends =
          stays_whole ? end : bring_image_to_front(image_of_shift_.data() + row.first_shift, to, end);
      rows.push_back({to - entries, row.cluster, row.first_shift});
      if (wanted == EntryOrder::joined)
        join(to, image_ends);
      else
        put_by_halves(to, image_ends);
      to = image_ends;
    }
  }

  std::vector<ClusterPairs::Row> rows;
  std::vector<ClusterPairs::RowParts> parts;

 private:
  void make_room(std::size_t entries) {
    for (auto& part : {&both_, &lower_, &upper_})
      if (part->size() < entries) part->resize(entries);
  }

  /// Whether all shifts of a node's rows lead to one image. Rows of a node stand behind each other.
  bool all_of_one_image(std::int32_t first_shift) {
    if (first_shift != asked_shift_) {
      asked_shift_ = first_shift;
      const auto first = static_cast<std::size_t>(first_shift);
      has_one_image_ = true;
      for (std::size_t s = first; s < pairs_.shift.size() && pairs_.shift[s].from == pairs_.shift[first].from;
           ++s)
        has_one_image_ = has_one_image_ && image_of_shift_[s] == image_of_shift_[first];
    }
    return has_one_image_;
  }

  /// Of entries [begin, end), those of the first one's image. Returns where they end.
  ClusterPairs::Entry* bring_image_to_front(const ImageKey* image, ClusterPairs::Entry* begin,
                                            ClusterPairs::Entry* end) {
    const ImageKey first = image[begin->shift];
    others_.resize(static_cast<std::size_t>(end - begin));
    ClusterPairs::Entry *same = begin, *other = others_.data();
    for (const ClusterPairs::Entry* from = begin; from != end; ++from) {  // no branches: hard to foretell
      const bool is_same = image[from->shift] == first;
      // Compilers copy entries number by number, and the processor waits for what is read as a whole then.
      std::uint64_t whole = 0;
      static_assert(sizeof whole == sizeof *from);
      std::memcpy(&whole, from, sizeof whole);
      std::memcpy(same, &whole, sizeof whole);
      std::memcpy(other, &whole, sizeof whole);
      same += is_same ? 1 : 0;
      other += is_same ? 0 : 1;
    }
    std::copy(others_.data(), other, same);
    return same;
  }

  /// Puts entries [begin, end), of one image if rows are cut by image, in order; so does the next.
  void put_by_halves(ClusterPairs::Entry* begin, ClusterPairs::Entry* end) {
    const detail::EntryHalves found = kernels_.split(begin, static_cast<std::int32_t>(end - begin),
                                                     {both_.data(), lower_.data(), upper_.data()});
    std::copy_n(both_.data(), found.both, begin);
    std::copy_n(lower_.data(), found.lower, begin + found.both);
    std::copy_n(upper_.data(), found.upper, begin + found.both + found.lower);
    parts.push_back({found.both, found.both + found.lower});
  }

  void join(ClusterPairs::Entry* begin, ClusterPairs::Entry* end) {
    const auto count = static_cast<std::int32_t>(end - begin);
    const std::int32_t turns = (count + detail::kJoinedAtOnce - 1) / detail::kJoinedAtOnce;
    ClusterPairs::Entry* alone = begin;
    ClusterPairs::Entry* joined = both_.data();
    for (std::int32_t turn = 0; turn < turns; ++turn) {
      const std::int32_t first = share_begin(count, turn, turns), last = share_begin(count, turn + 1, turns);
      const detail::JoinedEntries found = kernels_.join(begin + first, last - first, {alone, joined});
      alone += found.alone;
      joined += found.joined;
    }
    std::copy(both_.data(), joined, alone);
    parts.push_back({static_cast<std::int32_t>(alone - begin), 0});
  }

  const ClusterPairs& pairs_;
  const std::vector<ImageKey>& image_of_shift_;
  const detail::ClusterSearchKernels& kernels_;
  std::int32_t asked_shift_ = -1;
  bool has_one_image_ = false;
  std::vector<ClusterPairs::Entry> others_, both_, lower_, upper_;
};

}  // namespace

void ClusterPairs::order_entries(EntryOrder wanted, Executor* executor) {
  const bool is_done = wanted == EntryOrder::as_found || entry_order != EntryOrder::as_found;
  if (is_done || refreshes_before < steps_to_order(wanted) || rows.empty()) return;
  const std::vector<ImageKey> image_of_shift =
      wanted == EntryOrder::by_halves ? std::vector<ImageKey>() : keys_of_images(shift);
  const int slices = executor && executor->threads() > 1 ? kOrderSlicesPerThread * executor->threads() : 1;
  std::vector<RowOrderer> ordered(static_cast<std::size_t>(slices), RowOrderer(*this, image_of_shift));
  const std::size_t count = rows.size() - 1;
  const auto order = [&](int slice) {
    RowOrderer& own = ordered[static_cast<std::size_t>(slice)];
    const std::size_t last = share_begin(count, slice + 1, slices);
    for (std::size_t r = share_begin(count, slice, slices); r < last; ++r)
      own.order(r, wanted, entries.data());
  };
  if (slices == 1) {
    order(0);
  } else {
    executor->run(slices, order);
  }
  // Memory may be lacking until here: then rows are what they were, of the same entries.
  RowOrderer all = std::move(ordered.front());
  for (auto other = ordered.begin() + 1; other != ordered.end(); ++other) {
    all.rows.insert(all.rows.end(), other->rows.begin(), other->rows.end());
    all.parts.insert(all.parts.end(), other->parts.begin(), other->parts.end());
  }
  all.rows.push_back(rows.back());
  rows = std::move(all.rows);
  parts = std::move(all.parts);
  entry_order = wanted;
}

}  // namespace dch

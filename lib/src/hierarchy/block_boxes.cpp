// SPDX-License-Identifier: MIT
#include "hierarchy/block_boxes.hpp"

namespace dch::detail {

MeasuredLeaves::Corners BlockBoxes::corners(std::int32_t block) const {
  const Group& group = groups_[place_[block] / kBoxes];
  const std::int32_t n = place_[block] % kBoxes;
  return {{group.low[0][n], group.low[1][n], group.low[2][n]},
          {group.high[0][n], group.high[1][n], group.high[2][n]}};
}

/// A number of a leaf may be that of one that went.
void BlockBoxes::add_leaf(std::int32_t leaf) {
  first_.resize(std::max(first_.size(), static_cast<std::size_t>(leaf) + 1), kNone);
  first_[leaf] = kNone;
}

void BlockBoxes::add(std::int32_t leaf, std::int32_t block, const MeasuredLeaves::Corners& box) {
  std::int32_t& first = first_[leaf];
  if (first == kNone || groups_[first].count == kBoxes) first = new_group(first);
  Group& group = groups_[first];
  const std::int32_t n = group.count++;
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][n] = box.low[axis];
    group.high[axis][n] = box.high[axis];
  }
  group.block[n] = block;
  place_.resize(std::max(place_.size(), static_cast<std::size_t>(block) + 1), kNone);
  place_[block] = first * kBoxes + n;
}

void BlockBoxes::widen(std::int32_t block, const float at[3]) {
  Group& group = groups_[place_[block] / kBoxes];
  const std::int32_t n = place_[block] % kBoxes;
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][n] = std::min(group.low[axis][n], at[axis]);
    group.high[axis][n] = std::max(group.high[axis][n], at[axis]);
  }
}

/// The last box of the first group moves into the gap.
void BlockBoxes::remove(std::int32_t leaf, std::int32_t block) {
  const std::int32_t first = first_[leaf], last = first * kBoxes + groups_[first].count - 1;
  copy(last, place_[block]);
  if (--groups_[first].count > 0) return;
  first_[leaf] = groups_[first].next;
  free_.push_back(first);
}

void BlockBoxes::remove_all(std::int32_t leaf) {
  for (std::int32_t g = first_[leaf]; g != kNone; g = groups_[g].next) free_.push_back(g);
  first_[leaf] = kNone;
}

std::int32_t BlockBoxes::new_group(std::int32_t next) {
  std::int32_t g;
  if (free_.empty()) {
    g = static_cast<std::int32_t>(groups_.size());
    groups_.emplace_back();
  } else {
    g = free_.back();
    free_.pop_back();
  }
  groups_[g] = {};
  groups_[g].next = next;
  return g;
}

void BlockBoxes::copy(std::int32_t from, std::int32_t to) {
  const Group& source = groups_[from / kBoxes];
  Group& target = groups_[to / kBoxes];
  const std::int32_t k = from % kBoxes, n = to % kBoxes;
  for (int axis = 0; axis < 3; ++axis) {
    target.low[axis][n] = source.low[axis][k];
    target.high[axis][n] = source.high[axis][k];
  }
  target.block[n] = source.block[k];
  place_[target.block[n]] = to;
}

std::size_t BlockBoxes::memory_bytes() const {
  return groups_.capacity() * sizeof(Group) +
         (first_.capacity() + place_.capacity() + free_.capacity()) * sizeof(std::int32_t);
}

}  // namespace dch::detail

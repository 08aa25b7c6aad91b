// SPDX-License-Identifier: MIT
#include "closest_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/tolerance.hpp"

namespace dch::detail {
namespace {

/// Of numbers that are added up and subtracted again.
constexpr double kRounding = 1e-14;
/// So many times as far as rounding may be off a distance has to be for a bound to be worth something.
constexpr double kWorthwhile = 100;

}  // namespace

void ClosestBounds::grow(std::size_t points) {
  if (points <= size()) return;
  changed_at_.resize(points, 0);
  asked_at_.resize(points, 0);
  bounds_.grow(points, kFar);
  pairs_.grow(points, {});
}

void ClosestBounds::set_all(std::vector<Pair> pairs, std::int64_t asked_at) {
  changed_at_.assign(pairs.size(), asked_at);
  asked_at_.assign(pairs.size(), asked_at);
  bounds_ = Tournament<double>(std::vector<double>(pairs.size(), kFar));
  pairs_ = Tournament<Pair>(std::move(pairs));
  shrunk_ = 0;
}

void ClosestBounds::forget_all(const std::vector<char>& is_there) {
  std::vector<double> bounds;
  bounds.reserve(is_there.size());
  for (const char is_one_there : is_there) bounds.push_back(is_one_there ? -kFar : kFar);
  set_all(std::vector<Pair>(is_there.size()), 0);
  bounds_ = Tournament<double>(std::move(bounds));
}

void ClosestBounds::remove(std::int32_t id, std::int64_t now) {
  note_change(id, now);
  clear_pair(id);
  bounds_.set(id, kFar);
}

void ClosestBounds::set_nearest(std::int32_t id, const Pair& pair, std::int64_t now) {
  asked_at_[static_cast<std::size_t>(id)] = now;
  if (bounds_.of(id) != kFar) bounds_.set(id, kFar);
  pairs_.set(id, pair);
}

void ClosestBounds::set_none_within(std::int32_t id, double distance) {
  clear_pair(id);
  bounds_.set(id, distance / kInflate + shrunk_);
}

/// Few points have one, and memory is slow.
void ClosestBounds::clear_pair(std::int32_t id) {
  if (pairs_.of(id).a >= 0) pairs_.set(id, {});
}

/// What was known exactly is a bound from now on.
void ClosestBounds::shrink_all(double by) {
  std::vector<double> bounds(size());
  for (std::size_t k = 0; k < size(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    bounds[k] = pairs_.of(id).a < 0 ? bounds_.of(id) : bound_of(pairs_.of(id));
  }
  Tournament<Pair> none{std::vector<Pair>(size())};
  bounds_ = Tournament<double>(std::move(bounds));
  pairs_ = std::move(none);
  shrunk_ = std::nextafter(shrunk_ + by, kFar);  // rounding adds up over many steps, so it goes upwards
}

const ClosestBounds::Pair& ClosestBounds::closest() {
  static constexpr Pair kNoPair{};
  if (pairs_.empty()) return kNoPair;
  while (pairs_.top().a >= 0 && is_stale(pairs_.winner())) demote(pairs_.winner());
  return pairs_.top();
}

std::int32_t ClosestBounds::next_below(double distance) const {
  if (bounds_.empty() || !(bound(bounds_.winner()) <= distance * kInflate)) return -1;
  return bounds_.top() == kFar ? -1 : bounds_.winner();
}

double ClosestBounds::least_distance() const { return kWorthwhile * kRounding * shrunk_; }

double ClosestBounds::bound(std::int32_t id) const {
  const double set = bounds_.of(id);
  return std::isfinite(set) ? set - shrunk_ - kRounding * (set + shrunk_) : set;
}

std::size_t ClosestBounds::count_below(double distance) const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    const double least = bound(static_cast<std::int32_t>(k));
    count += least <= distance && least < kFar;
  }
  return count;
}

/// The partner has changed since, or the point itself. Those that came later have asked themselves.
bool ClosestBounds::is_stale(std::int32_t id) const {
  const Pair& pair = pairs_.of(id);
  const auto partner = static_cast<std::size_t>(pair.a == id ? pair.b : pair.a);
  const auto self = static_cast<std::size_t>(id);
  return std::max(changed_at_[partner], changed_at_[self]) > asked_at_[self];
}

/// The others are as far away as the partner was, or farther.
void ClosestBounds::demote(std::int32_t id) {
  const double bound = bound_of(pairs_.of(id));
  pairs_.set(id, {});
  bounds_.set(id, bound);
}

double ClosestBounds::bound_of(const Pair& pair) const {
  return std::sqrt(pair.distance2) / kInflate + shrunk_;
}

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#include "normal_cut.hpp"

#include <algorithm>

namespace dch::zonotope {

NormalCut::Best NormalCut::best_for(Vec3 x, const std::vector<Vec3>& generators,
                                    std::int64_t& operations) const {
  // n . x > 0 from or up to where it vanishes.
  const double constant = dot(start, x), rate = dot(along, x);
  double low = from, high = to;
  if (rate > 0)
    low = std::max(low, -constant / rate);
  else if (rate < 0)
    high = std::min(high, -constant / rate);
  else if (!(constant > 0))
    return {};
  if (!(low < high)) return {};
  const auto after = [&](double t) {  // the number of crossings up to t
    return static_cast<std::size_t>(std::upper_bound(crossings.begin(), crossings.end(), t,
                                                     [&](double at, const Crossing& c) {
                                                       ++operations;
                                                       return at < c.t;
                                                     }) -
                                    crossings.begin());
  };
  const auto gradient_after = [&](std::size_t count) {
    return count == 0 ? gradient : crossings[count - 1].gradient;
  };
  // Between two crossings the quotient rises or falls all along; it rises first and then falls.
  const auto rises = [&](std::size_t count) {
    ++operations;
    const Vec3 g = gradient_after(count);
    return rate * dot(g, start) - constant * dot(g, along) > 0;
  };
  const std::size_t first = after(low), last = after(high);
  std::size_t lower = first, upper = last + 1;  // the first of these that does not rise
  while (lower < upper) {
    const std::size_t middle = lower + (upper - lower) / 2;
    if (rises(middle))
      lower = middle + 1;
    else
      upper = middle;
  }
  Best best;
  if (lower == first && low == from) {
    best.place = Best::Place::start;
  } else if (lower > last && high == to) {
    best.place = Best::Place::end;
  } else {
    const std::size_t at = std::clamp(lower, std::size_t{1}, std::max(crossings.size(), std::size_t{1}));
    if (crossings.empty()) return {};
    best.place = Best::Place::crossing;
    best.crossing = at - 1;
    best.t = crossings[at - 1].t;
    const Vec3 u = generators[crossings[at - 1].generator];
    best.gradient = dot(along, u) > 0 ? gradient_after(at - 1) + u : gradient_after(at - 1) - u;
  }
  return best;
}

}  // namespace dch::zonotope

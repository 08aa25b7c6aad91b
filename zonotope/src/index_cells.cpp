// SPDX-License-Identifier: MIT
#include "index_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "vectors.hpp"

namespace dch::zonotope {
namespace {

constexpr std::size_t kSamples = 32;  // vertices drawn for each border

}  // namespace

/// The x of vertices that part all of them in about equal numbers; the first and the last are beyond all
/// vertices.
std::vector<double> IndexCells::borders_of(std::size_t strips) const {
  const std::size_t n = generators.size();
  std::vector<std::size_t> by_slope(n);
  std::iota(by_slope.begin(), by_slope.end(), std::size_t{0});
  std::sort(by_slope.begin(), by_slope.end(),
            [&](std::size_t a, std::size_t b) { return slope(a) < slope(b); });
  const auto meet = [&](std::size_t a, std::size_t b) {
    return (height(b, 0) - height(a, 0)) / (slope(a) - slope(b));
  };
  // The outermost vertices are those of lines that are next to each other by slope.
  double low = kInfinite, high = -kInfinite;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double x = meet(by_slope[k], by_slope[k + 1]);
    if (!std::isfinite(x)) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  std::vector<double> samples;
  std::mt19937_64 engine(1);
  for (std::size_t k = 0; k < kSamples * strips; ++k) {
    const std::size_t a = engine() % n, b = engine() % n;
    const double x = meet(a, b);
    if (a != b && x > low && x < high) samples.push_back(x);
  }
  std::sort(samples.begin(), samples.end());
  const double margin = 1 + std::abs(low) + std::abs(high);
  std::vector<double> borders{low - margin};
  for (std::size_t k = 1; k < strips && !samples.empty(); ++k) {
    const double x = samples[k * samples.size() / strips];
    if (x > borders.back()) borders.push_back(x);
  }
  borders.push_back(high + margin);
  return borders;
}

NormalCut IndexCells::border_at(double x) const {
  NormalCut border{{x, 0, 1}, {0, 1, 0}, -kInfinite, kInfinite, {}, {}};
  for (std::size_t k = 0; k < generators.size(); ++k) {
    border.crossings.push_back({height(k, x), k, {}});
    border.gradient = border.gradient - generators[k];
  }
  std::sort(border.crossings.begin(), border.crossings.end(),
            [](const auto& a, const auto& b) { return a.t != b.t ? a.t < b.t : a.generator < b.generator; });
  Vec3 gradient = border.gradient;
  for (NormalCut::Crossing& crossing : border.crossings)
    crossing.gradient = gradient = gradient + 2.0 * generators[crossing.generator];
  return border;
}

void IndexCells::build(std::vector<Vec3> given, std::size_t strips) {
  generators = std::move(given);
  for (Vec3& u : generators) {
    if (u.y < 0) u = -1.0 * u;
    if (u.y == 0) u.y = 1e-16 * std::sqrt(norm2(u));
  }
  band_ = std::max<std::size_t>(1, (generators.size() + strips - 1) / strips);
  for (const double x : borders_of(strips)) borders_.push_back(border_at(x));
  for (std::size_t left = 0; left + 1 < borders_.size(); ++left) build_strip(left);
  for (const NormalCut& border : borders_) entries += static_cast<std::int64_t>(border.crossings.size());
  for (const Strip& strip : strips_) {
    for (const NormalCut& cut : strip.cuts) entries += static_cast<std::int64_t>(cut.crossings.size());
    for (const Cell& cell : strip.cells) entries += static_cast<std::int64_t>(cell.generators.size());
  }
}

void IndexCells::build_strip(std::size_t left) {
  const NormalCut &a = borders_[left], &b = borders_[left + 1];
  const std::size_t n = generators.size(), bands = (n + band_ - 1) / band_;
  std::vector<std::size_t> rank_a(n), rank_b(n);
  for (std::size_t k = 0; k < n; ++k) {
    rank_a[a.crossings[k].generator] = k;
    rank_b[b.crossings[k].generator] = k;
  }
  Strip strip;
  strip.cells.resize(bands);
  for (std::size_t band = 1; band < bands; ++band) {
    const std::size_t rank = band * band_;
    const auto between = [&](const NormalCut& border) {
      return 0.5 * (border.crossings[rank - 1].t + border.crossings[rank].t);
    };
    NormalCut cut;
    cut.start = {a.start.x, between(a), 1};
    cut.along = Vec3{b.start.x, between(b), 1} - cut.start;
    cut.gradient = a.crossings[rank - 1].gradient;
    strip.cuts.push_back(std::move(cut));
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t band = std::min(rank_a[k], rank_b[k]) / band_ + 1;
         band <= std::max(rank_a[k], rank_b[k]) / band_; ++band) {
      NormalCut& cut = strip.cuts[band - 1];
      cut.crossings.push_back(
          {std::clamp(-dot(cut.start, generators[k]) / dot(cut.along, generators[k]), 0.0, 1.0), k, {}});
    }
  for (NormalCut& cut : strip.cuts) {
    std::sort(cut.crossings.begin(), cut.crossings.end(), [](const auto& c, const auto& d) {
      return c.t != d.t ? c.t < d.t : c.generator < d.generator;
    });
    Vec3 gradient = cut.gradient;
    for (NormalCut::Crossing& crossing : cut.crossings) {
      const Vec3 u = generators[crossing.generator];
      crossing.gradient = gradient = gradient + (dot(cut.along, u) > 0 ? 2.0 : -2.0) * u;
    }
  }
  add_to_cells(strip, rank_a, rank_b);
  strips_.push_back(std::move(strip));
}

void IndexCells::add_to_cells(Strip& strip, const std::vector<std::size_t>& left,
                              const std::vector<std::size_t>& right) const {
  const std::size_t bands = strip.cells.size();
  std::vector<Vec3> below(bands + 1), above(bands + 1);  // by the first band above, and the last one below
  for (std::size_t k = 0; k < generators.size(); ++k) {
    const std::size_t low = std::min(left[k], right[k]) / band_, high = std::max(left[k], right[k]) / band_;
    for (std::size_t band = low; band <= high; ++band) strip.cells[band].generators.push_back(k);
    below[high + 1] = below[high + 1] + generators[k];
    above[low] = above[low] + generators[k];
  }
  Vec3 sum;
  for (std::size_t band = 0; band < bands; ++band) {
    sum = sum + below[band];
    strip.cells[band].gradient = sum;
  }
  sum = {};
  for (std::size_t band = bands; band-- > 0;) {
    strip.cells[band].gradient = strip.cells[band].gradient - sum;
    sum = sum + above[band];
  }
}

/// On which side of a border the largest quotient is: along the line that goes through the best of the border
/// it rises there.
IndexCells::Side IndexCells::beside(std::size_t border, Vec3 x, std::int64_t& operations) const {
  const NormalCut& cut = borders_[border];
  const NormalCut::Best best = cut.best_for(x, generators, operations);
  if (best.place != NormalCut::Best::Place::crossing) {
    const double y = best.place == NormalCut::Best::Place::end ? kInfinite : -kInfinite;
    // At infinity, in the direction (0, 1, 0) or its opposite, to which all borders lead: which way it rises
    // from there.
    const Vec3 g = best.place == NormalCut::Best::Place::end ? cut.crossings.back().gradient : cut.gradient;
    const double rate = x.x * g.y - x.y * g.x;
    return {(rate > 0) == (y > 0) ? 1 : -1, y};
  }
  const Vec3 normal = cut.start + best.t * cut.along,
             along{1, slope(cut.crossings[best.crossing].generator), 0};
  const double rate = dot(x, along) * dot(best.gradient, normal) - dot(x, normal) * dot(best.gradient, along);
  return {rate > 0 ? 1 : rate < 0 ? -1 : 0, best.t};
}

/// Whether the largest quotient of a strip is above (1) or below (-1) a cut.
int IndexCells::above(const NormalCut& cut, Vec3 x, Side left, Side right, std::int64_t& operations) const {
  using BestPlace = NormalCut::Best::Place;
  const NormalCut::Best best = cut.best_for(x, generators, operations);
  if (best.place == BestPlace::nowhere) return x.y > 0 ? 1 : -1;  // n . x is positive on one side alone
  // At an end it is where the best of the border is, since quotients are quasi-concave.
  if (best.place == BestPlace::start) return left.y > cut.start.y ? 1 : -1;
  if (best.place == BestPlace::end) return right.y > cut.start.y + cut.along.y ? 1 : -1;
  const std::size_t k = cut.crossings[best.crossing].generator;
  const Vec3 normal = cut.start + best.t * cut.along, along{1, slope(k), 0};
  const double rate = dot(x, along) * dot(best.gradient, normal) - dot(x, normal) * dot(best.gradient, along);
  return (rate > 0) == (slope(k) * cut.along.x > cut.along.y) ? 1 : -1;
}

IndexCells::Place IndexCells::find(Vec3 x, std::int64_t& operations) const {
  std::size_t low = 0, high = borders_.size() - 1;
  Side left = beside(low, x, operations), right = beside(high, x, operations);
  if (left.side < 0 || right.side > 0) return {};
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    const Side side = beside(middle, x, operations);
    if (side.side > 0)
      low = middle, left = side;
    else
      high = middle, right = side;
  }
  const Strip& strip = strips_[low];
  std::size_t first = 0, last = strip.cuts.size();  // cells between
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    if (above(strip.cuts[middle], x, left, right, operations) > 0)
      first = middle + 1;
    else
      last = middle;
  }
  return {low, first};
}

bool IndexCells::holds(Place place, Vec3 normal) const {
  if (!(normal.z > 0)) return false;
  constexpr double kSlack = 1e-12;
  const Vec3 n = 1 / normal.z * normal;
  const double low = borders_[place.strip].start.x, high = borders_[place.strip + 1].start.x;
  const auto& cuts = strips_[place.strip].cuts;
  const double slack = kSlack * (1 + std::abs(n.x) + std::abs(n.y));
  const auto rise = [&](const NormalCut& cut) {
    return n.y - cut.start.y - (n.x - cut.start.x) / cut.along.x * cut.along.y;
  };
  return n.x >= low - slack && n.x <= high + slack &&
         (place.band == 0 || rise(cuts[place.band - 1]) >= -slack) &&
         (place.band == cuts.size() || rise(cuts[place.band]) <= slack);
}

}  // namespace dch::zonotope

// SPDX-License-Identifier: MIT
#include "long_double_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dch::hard {
namespace {

constexpr long double kFar = std::numeric_limits<long double>::infinity();
constexpr long double kRoundings = 16;  // a bound on their number in a distance by double precision

template <class V>
long double dot_of(const V& a, const V& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

long double size_of(Vec3 p) {
  return std::abs(static_cast<long double>(p.x)) + std::abs(static_cast<long double>(p.y)) +
         std::abs(static_cast<long double>(p.z));
}

}  // namespace

LongDoublePairs::LongDoublePairs(const std::vector<Vec3>& positions, const Box& box, double radius)
    : positions_(positions), radius_(radius) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!box.periodic(axis)) continue;
    const Vec3 v = box.vector(axis);
    period_.push_back({v.x, v.y, v.z});
    cell_size_ += size_of(v);
  }
  if (period_.empty()) return;
  invert_gram();
  for (std::size_t k = 0; k < period_.size(); ++k)
    skew_ += std::sqrt(dot_of(period_[k], period_[k]) * dot_of(dual_[k], dual_[k]));
}

/// The dual vectors are the rows of (A A^T)^-1 A, A having the periods for rows; by Gauss and Jordan.
void LongDoublePairs::invert_gram() {
  const std::size_t rank = period_.size();
  std::array<std::array<long double, 6>, 3> rows{};
  for (std::size_t k = 0; k < rank; ++k) {
    for (std::size_t l = 0; l < rank; ++l) rows[k][l] = dot_of(period_[k], period_[l]);
    std::copy(period_[k].begin(), period_[k].end(), rows[k].begin() + 3);
  }
  for (std::size_t k = 0; k < rank; ++k) {  // positive definite: pivots need no exchange
    for (std::size_t l = 0; l < rank; ++l) {
      if (l == k) continue;
      const long double factor = rows[l][k] / rows[k][k];
      for (std::size_t c = k; c < 6; ++c) rows[l][c] -= factor * rows[k][c];
    }
  }
  for (std::size_t k = 0; k < rank; ++k) {
    const long double pivot = rows[k][k];
    dual_.push_back({rows[k][3] / pivot, rows[k][4] / pivot, rows[k][5] / pivot});
  }
}

long double LongDoublePairs::distance(std::size_t i, std::size_t j) const {
  const Vec3 p = positions_[i], q = positions_[j];
  const LongVec apart = {static_cast<long double>(q.x) - p.x, static_cast<long double>(q.y) - p.y,
                         static_cast<long double>(q.z) - p.z};
  long double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (std::size_t k = 0; k < period_.size(); ++k) {
    const long double fraction = dot_of(dual_[k], apart), room = 1e-6L;
    const long double reach = radius_ * std::sqrt(dot_of(dual_[k], dual_[k])) + room;
    low[k] = std::ceil(-fraction - reach);
    high[k] = std::floor(-fraction + reach);
  }
  long double nearest2 = kFar;
  const auto period = [this](std::size_t k) { return k < period_.size() ? period_[k] : LongVec{}; };
  const LongVec a = period(0), b = period(1), c = period(2);
  for (long double x = low[0]; x <= high[0]; ++x)
    for (long double y = low[1]; y <= high[1]; ++y)
      for (long double z = low[2]; z <= high[2]; ++z) {
        LongVec image = apart;
        for (std::size_t k = 0; k < 3; ++k) image[k] += x * a[k] + y * b[k] + z * c[k];
        nearest2 = std::min(nearest2, dot_of(image, image));
      }
  return std::sqrt(nearest2);
}

long double LongDoublePairs::rounding(std::size_t i, std::size_t j) const {
  const long double largest = size_of(positions_[i]) + size_of(positions_[j]) + cell_size_ + radius_;
  return kRoundings * std::numeric_limits<double>::epsilon() * largest * skew_;
}

PairComparison& PairComparison::operator+=(const PairComparison& other) {
  pairs += other.pairs;
  in_doubt += other.in_doubt;
  missing += other.missing;
  too_many += other.too_many;
  return *this;
}

std::string PairComparison::text() const {
  return std::to_string(pairs) + " pairs, " + std::to_string(missing) + " missing, " +
         std::to_string(too_many) + " too many" +
         (in_doubt > 0 ? ", " + std::to_string(in_doubt) + " at the radius to rounding" : "");
}

PairComparison compare_pairs(const NeighborList& list, const std::vector<Vec3>& positions, const Box& box,
                             double radius) {
  const LongDoublePairs exact(positions, box, radius * (1 + 1e-6));
  PairComparison result;
  result.pairs = list.pairs();
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const auto row = list.row(i);
      const bool listed = std::binary_search(row.begin(), row.end(), static_cast<std::int32_t>(j));
      const long double beyond = exact.distance(i, j) - radius;
      if (std::abs(beyond) <= exact.rounding(i, j))
        ++result.in_doubt;
      else if (beyond < 0 && !listed)
        ++result.missing;
      else if (beyond > 0 && listed)
        ++result.too_many;
    }
  return result;
}

}  // namespace dch::hard

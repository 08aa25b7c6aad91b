// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include <dch/kinetic/contacts_between.hpp>

namespace dch::kinetic {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

Vector exact(Vec3 v) { return {v.x, v.y, v.z}; }
Vector plus(const Vector& a, Real factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Real times(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector across(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of a number of moderate size.
Real nearest_integer(Real x) {
  if (std::abs(x) > 1e9L) return std::round(x);
  return static_cast<Real>(static_cast<std::int64_t>(x + (x < 0 ? -0.5L : 0.5L)));
}

/// Periods and, for each, the normal of the planes that the others span: its product with a vector counts
/// these planes.
struct Cell {
  std::vector<Vector> periods, normals;

  void find_normals() {
    normals.clear();
    for (std::size_t k = 0; k < periods.size(); ++k) {
      Vector normal = periods[k];
      for (int pass = 0; pass < 2 && periods.size() == 2; ++pass) {
        const Vector& other = periods[1 - k];
        normal = plus(normal, -times(normal, other) / times(other, other), other);
      }
      if (periods.size() == 3) normal = across(periods[(k + 1) % 3], periods[(k + 2) % 3]);
      const Real scale = 1 / times(normal, periods[k]);
      normals.push_back({scale * normal[0], scale * normal[1], scale * normal[2]});
    }
  }
  /// The lattice vector nearest to a vector, of those about the one that rounding gives.
  Vector nearest(const Vector& v) const {
    const std::size_t rank = periods.size();
    Vector start{}, best{};
    for (std::size_t k = 0; k < rank; ++k) start = plus(start, std::round(times(normals[k], v)), periods[k]);
    Real least = std::numeric_limits<Real>::infinity();
    const int combinations = rank == 0 ? 1 : rank == 1 ? 5 : rank == 2 ? 25 : 125;
    for (int number = 0; number < combinations; ++number) {
      Vector there = start;
      for (std::size_t k = 0, rest = static_cast<std::size_t>(number); k < rank; ++k, rest /= 5)
        there = plus(there, static_cast<Real>(rest % 5) - 2, periods[k]);
      const Vector left = plus(v, -1, there);
      if (times(left, left) >= least) continue;
      least = times(left, left);
      best = there;
    }
    return best;
  }
};

Cell cell_of(const Box& box) {
  Cell cell;
  for (int k = 0; k < box.rank(); ++k)
    cell.periods.push_back(exact(box.reduced()[static_cast<std::size_t>(k)]));
  cell.find_normals();
  return cell;
}

/// How one image of a pair fares.
struct ImageSpan {
  Real enters, leaves, closest, margin;
  bool shown_before, shown_after;
};

class Oracle {
 public:
  Oracle(double cutoff, double slack, Span<const Vec3> before, const Box& box_before, Span<const Vec3> after,
         const Box& box_after)
      : cutoff_(cutoff), slack_(slack), then_(cell_of(box_before)) {
    const Cell lattice = cell_of(box_after);
    later_.periods.resize(then_.periods.size());
    for (std::size_t k = 0; k < then_.periods.size(); ++k) {
      later_.periods[k] = lattice.nearest(then_.periods[k]);
      gains_.push_back(plus(later_.periods[k], -1, then_.periods[k]));
    }
    later_.find_normals();
    const bool changes =
        std::any_of(gains_.begin(), gains_.end(), [](const Vector& gain) { return times(gain, gain) > 0; });
    Vector shift{};
    const Vector origin = exact(box_before.origin()), moved = plus(exact(box_after.origin()), -1, origin);
    for (std::size_t k = 0; k < gains_.size() && changes; ++k)
      shift = plus(shift, times(later_.normals[k], moved), later_.periods[k]);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vector p = exact(before[i]);
      Vector carried = plus(p, 1, shift);
      for (std::size_t k = 0; k < gains_.size(); ++k)
        carried = plus(carried, times(then_.normals[k], plus(p, -1, origin)), gains_[k]);
      const Vector q = exact(after[i]);
      const Vector image = plus(q, -1, lattice.nearest(plus(q, -1, carried)));
      from_.push_back(p);
      way_.push_back(plus(image, -1, p));
    }
    for (const Vector& gain : gains_) {
      Real sum = 0;
      for (const Vector& normal : then_.normals) sum += std::abs(times(normal, gain));
      strain_ = std::max(strain_, sum);
    }
    count_planes(cutoff + slack);
  }

  /// The contacts of a pair that are hidden, or nearly so.
  void look_at(std::int32_t i, std::int32_t j, std::vector<OracleContact>& out) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    Vector apart, rate;
    spans_.clear();
    std::array<int, 3> least{0, 0, 0}, most{0, 0, 0};
    if (!images_in_reach(a, b, apart, rate, least, most)) return;
    for (int x = least[0]; x <= most[0]; ++x)
      for (int y = least[1]; y <= most[1]; ++y)
        for (int z = least[2]; z <= most[2]; ++z) {
          const std::array<int, 3> n{x, y, z};
          Vector d = apart, v = rate;
          for (std::size_t k = 0; k < gains_.size(); ++k) {
            d = plus(d, n[k], then_.periods[k]);
            v = plus(v, n[k], gains_[k]);
          }
          look_at_image(d, v);
        }
    tell(i, j, out);
  }

 private:
  /// Moves the pair to near images, and says which others may come within the cutoff. Numbers of planes
  /// between two points change linearly with time, but for what the box's own change adds.
  bool images_in_reach(std::size_t a, std::size_t b, Vector& apart, Vector& rate, std::array<int, 3>& least,
                       std::array<int, 3>& most) const {
    const std::size_t rank = gains_.size();
    Vector first{}, last{}, shift{};
    Real largest = 0;
    for (std::size_t k = 0; k < rank; ++k) {
      first[k] = planes_before_[b][k] - planes_before_[a][k];
      shift[k] = -nearest_integer(first[k]);
      first[k] += shift[k];
      last[k] = planes_after_[b][k] - planes_after_[a][k] + shift[k];
      largest = std::max({largest, std::abs(first[k]), std::abs(last[k])});
    }
    for (std::size_t k = 0; k < rank; ++k) {
      const Real reach = reach_[k] * (1 + 12 * strain_) + 1e-9L + 8 * strain_ * (1 + largest);
      const Real low = -std::max(first[k], last[k]) - reach, high = -std::min(first[k], last[k]) + reach;
      if (low > 0 && high < 1) return false;
      least[k] = static_cast<int>(std::ceil(low));
      most[k] = static_cast<int>(std::floor(high));
      if (least[k] > most[k]) return false;
    }
    apart = plus(from_[b], -1, from_[a]);
    rate = plus(way_[b], -1, way_[a]);
    for (std::size_t k = 0; k < rank; ++k) {
      apart = plus(apart, shift[k], then_.periods[k]);
      rate = plus(rate, shift[k], gains_[k]);
    }
    return true;
  }

  /// How many planes of each period lie before the points.
  void count_planes(double reach) {
    for (std::size_t i = 0; i < from_.size(); ++i) {
      Vector before{}, after{};
      const Vector end = plus(from_[i], 1, way_[i]);
      for (std::size_t k = 0; k < gains_.size(); ++k) {
        before[k] = times(then_.normals[k], from_[i]);
        after[k] = times(later_.normals[k], end);
      }
      planes_before_.push_back(before);
      planes_after_.push_back(after);
    }
    for (std::size_t k = 0; k < gains_.size(); ++k) {
      reach_[k] = reach * std::sqrt(std::max(times(then_.normals[k], then_.normals[k]),
                                             times(later_.normals[k], later_.normals[k])));
    }
  }

  void look_at_image(const Vector& d, const Vector& v) {
    const Vector end = plus(d, 1, v);
    const Real a = times(v, v), b = times(d, v), c = times(d, d);
    const Real turn = a > 0 ? -b / a : 0;
    const Vector there = plus(d, std::clamp(turn, Real{0}, Real{1}), v);
    const Real first = std::sqrt(c), last = std::sqrt(times(end, end)),
               closest = std::sqrt(times(there, there));
    if (closest > cutoff_ + slack_) return;
    const Real root = a > 0 ? std::sqrt(std::max(Real{0}, b * b - a * (c - cutoff_ * cutoff_))) / a : 0;
    spans_.push_back({std::clamp(turn - root, Real{0}, Real{1}), std::clamp(turn + root, Real{0}, Real{1}),
                      closest, std::min({first - cutoff_, last - cutoff_, cutoff_ - closest}),
                      first < cutoff_ - slack_, last < cutoff_ - slack_});
  }

  void tell(std::int32_t i, std::int32_t j, std::vector<OracleContact>& out) {
    std::sort(spans_.begin(), spans_.end(),
              [](const ImageSpan& x, const ImageSpan& y) { return x.enters < y.enters; });
    for (std::size_t k = 0; k < spans_.size();) {
      ImageSpan whole = spans_[k++];
      for (; k < spans_.size() && spans_[k].enters <= whole.leaves; ++k) {
        whole.leaves = std::max(whole.leaves, spans_[k].leaves);
        whole.closest = std::min(whole.closest, spans_[k].closest);
        whole.margin = std::min(whole.margin, spans_[k].margin);
        whole.shown_before = whole.shown_before || spans_[k].shown_before;
        whole.shown_after = whole.shown_after || spans_[k].shown_after;
      }
      if (whole.shown_before || whole.shown_after) continue;
      OracleContact contact;
      contact.i = std::min(i, j);
      contact.j = std::max(i, j);
      contact.enters = static_cast<double>(whole.enters);
      contact.leaves = static_cast<double>(whole.leaves);
      contact.closest = static_cast<double>(whole.closest);
      contact.margin = static_cast<double>(whole.margin);
      out.push_back(contact);
    }
  }

  Real cutoff_, slack_;
  Cell then_, later_;          ///< the later cell by the vectors that those of the earlier one go to
  std::vector<Vector> gains_;  ///< of the periods
  Real strain_ = 0;
  std::vector<Vector> from_, way_;  ///< of each point: where it is before, and its displacement
  std::vector<Vector> planes_before_, planes_after_;
  Vector reach_{};  ///< of the cutoff, in planes
  std::vector<ImageSpan> spans_;
};

}  // namespace

std::vector<OracleContact> all_hidden_contacts(double cutoff, double slack, Span<const Vec3> before,
                                               const Box& box_before, Span<const Vec3> after,
                                               const Box& box_after, Span<const std::int32_t> undetermined,
                                               Span<const std::int32_t> points) {
  Oracle oracle(cutoff, slack, before, box_before, after, box_after);
  const auto n = static_cast<std::int32_t>(before.size());
  std::vector<bool> is_left_out(before.size(), false), is_done(before.size(), false);
  for (const std::int32_t id : undetermined) is_left_out[static_cast<std::size_t>(id)] = true;
  std::vector<std::int32_t> rows(points.begin(), points.end());
  if (rows.empty()) {
    rows.resize(before.size());
    std::iota(rows.begin(), rows.end(), 0);
  }
  std::vector<OracleContact> found;
  for (const std::int32_t i : rows) {
    is_done[static_cast<std::size_t>(i)] = true;
    if (is_left_out[static_cast<std::size_t>(i)]) continue;
    for (std::int32_t j = 0; j < n; ++j)
      if (!is_done[static_cast<std::size_t>(j)] && !is_left_out[static_cast<std::size_t>(j)])
        oracle.look_at(i, j, found);
  }
  std::sort(found.begin(), found.end(), [](const OracleContact& x, const OracleContact& y) {
    if (x.i != y.i) return x.i < y.i;
    return x.j != y.j ? x.j < y.j : x.enters < y.enters;
  });
  return found;
}

}  // namespace dch::kinetic

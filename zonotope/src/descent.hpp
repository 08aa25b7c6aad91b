// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <dch/base/span.hpp>

#include "exact.hpp"
#include "vectors.hpp"

namespace dch::zonotope {

/// Goes from facet to facet of a zonotope around the origin to the one that the ray to a point meets. In
/// normals n: minimises h(n) = sum |n . u_k| on the plane n . point = const. That is convex, and linear but
/// for kinks along the lines n . u_k = 0, whose arrangement is dual to the facets (thesis 3.3). A step goes
/// along a line, in a direction where h falls, to its minimum on this line. At a minimum no direction of a
/// line through it falls; where several lines meet in a point (coplanar generators), or coincide (parallel
/// ones), all of those are tried.
///
/// With Exact numbers it ends at the minimum, since h falls strictly; with doubles after as many steps as the
/// caller allows. O(n log n) a step, and O(t^2) for t lines in one point.
template <class Number>
class Descent {
 public:
  Descent(Span<const Vec<Number>> generators, const Vec<Number>& point)
      : generators_(generators), point_(point), products_(generators.size()) {}

  /// @param i, j generators whose plane does not hold the point
  void start(std::size_t i, std::size_t j) { move_to(i, j); }
  /// @param normal any vector n with n . point > 0, about normal to generator i
  void start(const Vec<Number>& normal, std::size_t i) {
    normal_ = normal;
    i_ = j_ = i;
    measure();
  }

  /// One step; false at the minimum.
  bool step() {
    const Vec<Number> fixed = gradient();
    for (const std::size_t t : tight_)
      for (const bool turned : {false, true}) {
        const Vec<Number> along = turned ? cross(point_, generators_[t]) : cross(generators_[t], point_);
        Number slope = dot(fixed, along);
        for (const std::size_t k : tight_) slope = slope + magnitude(dot(generators_[k], along));
        if (sign_of(slope) < 0 && walk(t, along, slope)) return true;
      }
    return false;
  }

  const Vec<Number>& normal() const { return normal_; }
  std::size_t i() const { return i_; }
  std::size_t j() const { return j_; }  ///< equal to i() before the first step of a start at a normal
  /// normal . generators[k]
  const std::vector<Number>& products() const { return products_; }
  /// h(n) and n . point.
  Number support() const {
    Number sum = 0.0;
    for (const Number& w : products_) sum = sum + magnitude(w);
    return sum;
  }
  Number height() const { return dot(normal_, point_); }

 private:
  struct Kink {
    double guess;  ///< of where along the line
    std::size_t generator;
  };

  static Number magnitude(const Number& x) { return sign_of(x) < 0 ? -x : x; }

  void move_to(std::size_t i, std::size_t j) {
    normal_ = cross(generators_[i], generators_[j]);
    if (sign_of(dot(normal_, point_)) < 0) normal_ = -normal_;
    i_ = i;
    j_ = j;
    measure();
  }

  void measure() {
    tight_.clear();
    for (std::size_t k = 0; k < generators_.size(); ++k) {
      products_[k] = dot(normal_, generators_[k]);
      if (k == i_ || k == j_ || is_tight(k)) tight_.push_back(k);
    }
  }

  bool is_tight(std::size_t k) const {
    if constexpr (std::is_same_v<Number, double>) {
      const Vec3 n = magnitudes(vec3(normal_)), u = magnitudes(vec3(generators_[k]));
      return std::abs(products_[k]) <= 1e-14 * dch::dot(n, u);
    } else {
      return sign_of(products_[k]) == 0;
    }
  }

  Vec<Number> gradient() const {
    Vec<Number> sum{};
    std::size_t next = 0;
    for (std::size_t k = 0; k < generators_.size(); ++k) {
      if (next < tight_.size() && tight_[next] == k)
        ++next;
      else
        sum = sign_of(products_[k]) > 0 ? sum + generators_[k] : sum - generators_[k];
    }
    return sum;
  }

  /// Whether the kink of a comes before that of b: |w_a| / |e_a| < |w_b| / |e_b|.
  bool is_before(const Kink& a, const Kink& b) const {
    if constexpr (!std::is_same_v<Number, double>) {
      if (!(std::abs(a.guess - b.guess) > 1e-13 * std::max(a.guess, b.guess) &&
            std::isfinite(a.guess + b.guess)))
        return sign_of(magnitude(products_[a.generator]) * slopes_[b.generator] -
                       magnitude(products_[b.generator]) * slopes_[a.generator]) < 0;
    }
    return a.guess < b.guess;
  }

  /// To the minimum along a line, from where h has the given slope, below 0. False if there is none, which
  /// takes rounding.
  bool walk(std::size_t t, const Vec<Number>& along, Number slope) {
    kinks_.clear();
    slopes_.assign(generators_.size(), Number(0.0));
    std::size_t next = 0;
    for (std::size_t k = 0; k < generators_.size(); ++k) {
      if (next < tight_.size() && tight_[next] == k) {
        ++next;
        continue;
      }
      const Number rate = dot(generators_[k], along);
      if (sign_of(rate) * sign_of(products_[k]) >= 0) continue;
      slopes_[k] = magnitude(rate);
      kinks_.push_back({std::abs(value_of(products_[k])) / value_of(slopes_[k]), k});
    }
    std::sort(kinks_.begin(), kinks_.end(), [&](const Kink& a, const Kink& b) { return is_before(a, b); });
    for (const Kink& kink : kinks_) {
      slope = slope + slopes_[kink.generator] + slopes_[kink.generator];
      if (sign_of(slope) < 0) continue;
      move_to(t, kink.generator);
      return true;
    }
    return false;
  }

  Span<const Vec<Number>> generators_;
  Vec<Number> point_, normal_;
  std::size_t i_ = 0, j_ = 0;
  std::vector<Number> products_, slopes_;
  std::vector<std::size_t> tight_;  ///< generators with product 0, ascending
  std::vector<Kink> kinks_;
};

}  // namespace dch::zonotope

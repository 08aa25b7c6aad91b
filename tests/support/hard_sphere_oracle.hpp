// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include <dch/kinetic/hard_spheres.hpp>

namespace dch::kinetic {

/// Event-driven hard spheres by all pairs and all images, in long double: of each pair the roots of a
/// quadratic equation, then the least of all. Between two collisions it takes over where the engine is, so
/// that rounding does not grow from one to the next.
class HardSphereOracle {
 public:
  using Real = long double;
  struct Next {
    Real after = kNever;  ///< from where the engine is
    Edge pair;
  };

  /// @param growth of each radius, by sphere [length/time]
  HardSphereOracle(const HardSpheres& engine, double restitution, std::vector<double> growth)
      : engine_(engine), restitution_(restitution), growth_(std::move(growth)) {
    take();
  }

  void take() {
    spheres_.clear();
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(engine_.size()); ++id)
      spheres_.push_back({engine_.position(id), engine_.velocity(id), engine_.radius(id)});
    now_ = engine_.now();
  }

  /// The next collision up to a time; none has no pair.
  Next next(double limit) const {
    const Real rest = Real(limit) - now_, height = engine_.box().min_height();
    Real fastest = 0;
    for (const Sphere& s : spheres_) fastest = std::max(fastest, std::sqrt(Real(norm2(s.velocity))));
    // No image that is not looked at comes near within such a time.
    const Real stretch = std::isinf(height) || fastest == 0 ? rest : height / (8 * fastest);
    for (Real from = 0; from <= rest; from += stretch) {
      Next found;
      for_each_pair([&](Edge pair) {
        const Real after = contact_after(pair, from);
        if (after < found.after) found = {after, pair};
      });
      if (found.after <= std::min(stretch, rest - from)) return {from + found.after, found.pair};
      if (stretch == rest) break;
    }
    return {};
  }
  double now() const { return static_cast<double>(now_); }

  /// Compares what the engine did at a collision with the laws of mechanics, then takes over.
  void check(const Collision& collision) {
    const Sphere &p = spheres_[collision.pair.a], &q = spheres_[collision.pair.b];
    const double passed = static_cast<double>(Real(collision.time) - now_);
    const Vec3 normal =
        engine_.box().nearest_image(engine_.position(collision.pair.b) - engine_.position(collision.pair.a));
    const double distance = std::sqrt(norm2(normal));
    const double walls = growth_[collision.pair.a] + growth_[collision.pair.b];
    const double before = dot(q.velocity - p.velocity, normal) / distance - walls;
    const double first = engine_.mass(collision.pair.a), second = engine_.mass(collision.pair.b);
    const double kick = -(1 + restitution_) * before * first * second / (first + second);
    const double fast = std::sqrt(std::max(norm2(p.velocity), norm2(q.velocity))) + walls;
    // Of several at one time any may be the first.
    EXPECT_NEAR(distance / (engine_.radius(collision.pair.a) + engine_.radius(collision.pair.b)), 1, 1e-12);
    EXPECT_LT(before, 1e-9 * fast) << "they part";
    EXPECT_NEAR(collision.impulse, kick, 1e-9 * fast * std::min(first, second));
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(spheres_.size()); ++id) {
      const Sphere& s = spheres_[id];
      Vec3 velocity = s.velocity;
      if (id == collision.pair.a) velocity = velocity - (kick / first / distance) * normal;
      if (id == collision.pair.b) velocity = velocity + (kick / second / distance) * normal;
      ASSERT_LT(norm2(engine_.velocity(id) - velocity), 1e-16 * fast * fast) << id;
      const Vec3 there = s.position + passed * s.velocity;
      ASSERT_LT(engine_.box().distance2(engine_.position(id), there), 1e-18) << id;
    }
    take();
  }

  /// Over the sum of the radii, minus 1.
  double least_gap() const {
    double least = kNever;
    for_each_pair([&](Edge pair) {
      const Sphere &p = spheres_[pair.a], &q = spheres_[pair.b];
      least = std::min(
          least, std::sqrt(engine_.box().distance2(p.position, q.position)) / (p.radius + q.radius) - 1);
    });
    return least;
  }

 private:
  struct Sphere {
    Vec3 position, velocity;
    double radius;
  };

  template <class F>
  void for_each_pair(const F& f) const {
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(spheres_.size()); ++a)
      for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(spheres_.size()); ++b) f(Edge{a, b});
  }
  template <class F>
  void for_each_image(const F& f) const {
    std::array<int, 3> most{};
    for (int k = 0; k < engine_.box().rank(); ++k) most[k] = 1;
    const auto& cell = engine_.box().reduced();
    for (int i = -most[0]; i <= most[0]; ++i)
      for (int j = -most[1]; j <= most[1]; ++j)
        for (int k = -most[2]; k <= most[2]; ++k)
          f(double(i) * cell[0] + double(j) * cell[1] + double(k) * cell[2]);
  }
  /// How long until a pair touches by an image that is near then.
  Real contact_after(Edge pair, Real from) const {
    const Sphere &p = spheres_[pair.a], &q = spheres_[pair.b];
    const double passed = static_cast<double>(from);
    const Vec3 v = q.velocity - p.velocity;
    const Vec3 apart = engine_.box().nearest_image(q.position - p.position + passed * v);
    const Real grows = Real(growth_[pair.a]) + growth_[pair.b];
    const Real distance = Real(p.radius) + q.radius + grows * from;
    Real least = kNever;
    for_each_image([&](Vec3 shift) { least = std::min(least, root(apart + shift, v, distance, grows)); });
    return least;
  }

  static Real root(Vec3 r, Vec3 v, Real d, Real g) {
    const auto product = [](Vec3 x, Vec3 y) { return Real(x.x) * y.x + Real(x.y) * y.y + Real(x.z) * y.z; };
    const Real square = product(v, v) - g * g, half = product(r, v) - d * g, rest = product(r, r) - d * d;
    if (half >= 0 && square >= 0) return kNever;
    if (half < 0 && rest < 0) return 0;  // they touch, to within rounding
    const Real discriminant = half * half - square * rest;
    if (discriminant <= 0) return kNever;
    if (square == 0) return -rest / (2 * half);
    return (-half - std::sqrt(discriminant)) / square;
  }

  const HardSpheres& engine_;
  double restitution_;
  std::vector<double> growth_;
  std::vector<Sphere> spheres_;
  Real now_ = 0;
};

}  // namespace dch::kinetic

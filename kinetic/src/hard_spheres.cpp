// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>
#include <string>

#include <dch/base/error.hpp>
#include <dch/kinetic/hard_spheres.hpp>

#include "argument_checks.hpp"
#include "base/describe.hpp"
#include "geometry/position_check.hpp"
#include "sphere_engine.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

void check_number_of(const char* what, std::size_t given, std::size_t spheres) {
  if (given == spheres) return;
  throw InvalidParameter(std::to_string(given) + " " + what + " for " + std::to_string(spheres) +
                         " spheres; give one for each");
}

void check_sizes(const HardSphereParams& params, std::size_t spheres) {
  check_number_of("radii", params.radii.size(), spheres);
  if (!params.masses.empty()) check_number_of("masses", params.masses.size(), spheres);
  double largest = 0;
  for (std::size_t i = 0; i < spheres; ++i) {
    check_length(params.radii[i], "radius of sphere " + std::to_string(i));
    largest = std::max(largest, 2 * params.radii[i]);
  }
  for (std::size_t i = 0; i < params.masses.size(); ++i)
    if (!(params.masses[i] >= 1 / kMaxMagnitude && params.masses[i] <= kMaxMagnitude))
      throw InvalidParameter("mass of sphere " + std::to_string(i) + " = " + describe(params.masses[i]) +
                             " is not within " + describe(1 / kMaxMagnitude) + ".." +
                             describe(kMaxMagnitude) + "; give a mass above 0, in another unit if need be");
  const double limit = kMaxShareOfBox * params.box.max_cutoff();
  if (largest > limit)
    throw CutoffTooLarge("the largest diameter = " + describe(largest) + " exceeds " + describe(limit) +
                         ", " + describe(kMaxShareOfBox) +
                         " of half the smallest height of the periodic box; take smaller spheres or more of "
                         "them in a larger box");
}

void check_spheres(const HardSphereParams& params, Span<const Vec3> positions, Span<const Vec3> velocities,
                   double start) {
  check_time(start, "start");
  check_number_of("velocities", velocities.size(), positions.size());
  if (!(params.restitution > 0 && params.restitution <= 1))
    throw InvalidParameter("restitution = " + describe(params.restitution) +
                           " is not above 0 and at most 1; 1 is elastic");
  check_sizes(params, positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto of_sphere = [i](const char* what) {
      return [what, i] { return what + std::string(" of sphere ") + std::to_string(i); };
    };
    check(positions[i], of_sphere("position"), "check the coordinates");
    check(velocities[i], of_sphere("velocity"), "check what it was computed from");
  }
  detail::check_positions(positions, params.box);
}

}  // namespace

struct HardSpheres::Impl {
  Impl(const HardSphereParams& given, Span<const Vec3> positions, Span<const Vec3> velocities, double start)
      : params(given),
        engine(given, positions, velocities),
        zero(start),
        now(start),
        count(positions.size()) {}

  static std::size_t place(std::int32_t id) { return static_cast<std::size_t>(id); }
  double mass(std::int32_t id) const { return params.masses.empty() ? 1 : params.masses[place(id)]; }
  template <class F>
  void for_each(const F& f) const {
    for (std::size_t i = 0; i < count; ++i) f(static_cast<std::int32_t>(i));
  }
  /// What follows ends with is_whole = true, unless it throws.
  void begin_change() {
    if (!is_whole)
      throw InvalidParameter("an earlier step was broken off, at " + describe(now) +
                             "; start anew from the spheres of then");
    is_whole = false;
  }
  void synchronize() {
    begin_change();
    engine.synchronize();
    zero = now;
    is_whole = true;
  }
  std::optional<Collision> step(double limit) {
    begin_change();
    auto collision = engine.step(std::max(limit - zero, engine.now()));
    is_whole = true;
    now = collision ? std::clamp(zero + collision->time, now, limit) : limit;
    if (collision) collision->time = now;
    return collision;
  }

  HardSphereParams params;
  SphereEngine engine;
  double zero;  ///< the time at which the engine's clock was zero
  double now;   ///< by that clock to within rounding
  std::size_t count;
  bool is_whole = true;  ///< whether no change has been broken off
};

HardSpheres::HardSpheres(const HardSphereParams& params, Span<const Vec3> positions,
                         Span<const Vec3> velocities, double start) {
  check_spheres(params, positions, velocities, start);
  impl_ = std::make_unique<Impl>(params, positions, velocities, start);
}

HardSpheres::~HardSpheres() = default;
HardSpheres::HardSpheres(HardSpheres&&) noexcept = default;
HardSpheres& HardSpheres::operator=(HardSpheres&&) noexcept = default;

std::size_t HardSpheres::size() const { return impl_->count; }
const Box& HardSpheres::box() const { return impl_->params.box; }
double HardSpheres::now() const { return impl_->now; }
double HardSpheres::radius(std::int32_t id) const { return impl_->engine.radius(id); }
double HardSpheres::mass(std::int32_t id) const { return impl_->mass(id); }
Vec3 HardSpheres::position(std::int32_t id) const { return impl_->engine.position(id); }
Vec3 HardSpheres::velocity(std::int32_t id) const { return impl_->engine.velocity(id); }
double HardSpheres::virial() const { return impl_->engine.virial(); }
const HardSphereCounters& HardSpheres::counters() const { return impl_->engine.counters(); }
double HardSpheres::least_gap() const { return impl_->engine.least_gap(); }

double HardSpheres::energy() const {
  double sum = 0;
  impl_->for_each([&](std::int32_t id) { sum += 0.5 * mass(id) * norm2(velocity(id)); });
  return sum;
}

Vec3 HardSpheres::momentum() const {
  Vec3 sum;
  impl_->for_each([&](std::int32_t id) { sum = sum + mass(id) * velocity(id); });
  return sum;
}

double HardSpheres::volume() const {
  double sum = 0;
  impl_->for_each([&](std::int32_t id) {
    const double r = radius(id);
    sum += 4 * std::numbers::pi / 3 * r * r * r;
  });
  return sum;
}

std::optional<Collision> HardSpheres::step(double limit) {
  check_time(limit, "time");
  if (limit < now())
    throw InvalidParameter("time = " + describe(limit) + " is before now, " + describe(now()) +
                           "; time does not run back: start anew from the spheres of then");
  if (impl_->engine.has_long_run()) synchronize();
  return impl_->step(limit);
}

void HardSpheres::advance_to(double time) {
  while (step(time)) {
  }
}

void HardSpheres::set_growth(double rate) {
  if (!(rate >= 0 && rate <= kMaxMagnitude))
    throw InvalidParameter("growth = " + describe(rate) + " is not within 0.." + describe(kMaxMagnitude) +
                           "; radii can grow or stay");
  synchronize();
  impl_->begin_change();
  impl_->engine.set_growth(rate);
  impl_->is_whole = true;
}

void HardSpheres::scale_velocities(double factor) {
  if (!(factor > 0 && factor <= kMaxMagnitude))
    throw InvalidParameter("factor of velocities = " + describe(factor) + " is not above 0 and at most " +
                           describe(kMaxMagnitude) + "; choose another");
  synchronize();
  impl_->begin_change();
  impl_->engine.scale_velocities(factor);
  impl_->is_whole = true;
}

void HardSpheres::synchronize() { impl_->synchronize(); }

}  // namespace dch::kinetic

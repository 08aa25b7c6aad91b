// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

struct HardSphereParams {
  Box box{};
  std::vector<double> radii{};   ///< one for each sphere, > 0 [length]
  std::vector<double> masses{};  ///< one for each sphere, > 0; empty: 1 each [mass]
  /// Of the normal relative velocity, what a collision leaves of it: 1 is elastic, > 0.
  double restitution = 1;
};

/// Two spheres that touched, and then have the velocities of after.
struct Collision {
  double time = 0;
  Edge pair;
  double impulse = 0;  ///< that each of both was given, along the line of centers [mass length/time]
};

/// What was done since the start: the same on any machine.
struct HardSphereCounters {
  std::int64_t collisions = 0;
  std::int64_t predictions = 0;  ///< of the collision of a pair
  std::int64_t homes = 0;        ///< spheres that left the ball around their home
  std::int64_t anchors = 0;      ///< spheres that were searched for by a descent of hierarchies
};

/// Overlaps up to this share of the distance of a pair are those of rounding, and taken.
inline constexpr double kTouching = 1e-9;

/// Event-driven molecular dynamics of hard spheres of any sizes: between collisions they fly straight, at a
/// collision both get new velocities (B. J. Alder and T. E. Wainwright, J. Chem. Phys. 31:459, 1959). Radii
/// may grow at a constant rate (B. D. Lubachevsky and F. H. Stillinger, J. Stat. Phys. 60:561, 1990).
///
/// Each sphere has a ball around its home and stays in it until its exit (thesis 5.5.3, end: one expiry a
/// point). Only spheres whose balls touch can collide before an exit; these pairs are tracked. A wider ball
/// around an anchor holds the homes that are to come, so that a new home is found among the spheres whose
/// wide balls touch; only a new anchor is searched for, by a descent of hierarchies, one for each octave of
/// sizes. Both kinds of ball become wider or tighter so that a sphere has some collisions before it leaves a
/// home, and some homes before it leaves an anchor: nothing depends on density, or on the ratio of sizes. A
/// collision costs O(tracked pairs of both + lg n).
///
/// Collisions at the same time come in the order of ids. The same start gives the same collisions to the last
/// bit; so does a start from what positions(), velocities(), radii and clocks were just after synchronize().
/// Along axes that are not periodic space has no end. Not thread-safe.
///
/// What is thrown for arguments that do not fit changes nothing. After anything else that step() or
/// advance_to() throw, these throw InvalidParameter.
class HardSpheres {
 public:
  /// @throws InvalidParameter for radii and masses that do not fit or are out of range, numbers that are not
  ///   finite, a restitution outside of (0, 1], and spheres that overlap, which it names; InvalidPosition;
  ///   CutoffTooLarge if the largest diameter exceeds kMaxShareOfBox of box.max_cutoff().
  HardSpheres(const HardSphereParams& params, Span<const Vec3> positions, Span<const Vec3> velocities,
              double start = 0);
  ~HardSpheres();
  HardSpheres(HardSpheres&&) noexcept;
  HardSpheres& operator=(HardSpheres&&) noexcept;

  std::size_t size() const;
  const Box& box() const;
  /// The time up to which everything has happened.
  double now() const;
  double radius(std::int32_t id) const;  ///< now [length]
  double mass(std::int32_t id) const;
  Vec3 position(std::int32_t id) const;  ///< now, in the cell [length]
  Vec3 velocity(std::int32_t id) const;  ///< now [length/time]
  double energy() const;                 ///< kinetic. O(n)
  Vec3 momentum() const;                 ///< O(n)
  double volume() const;                 ///< of all spheres now [length^3]. O(n)
  /// Sum over the collisions since the start of distance times impulse: what it gains in a time, over that
  /// time, is three times the volume times the pressure beyond that of an ideal gas [energy time].
  double virial() const;
  const HardSphereCounters& counters() const;
  /// Of all pairs, the least distance over the sum of the radii, minus 1: negative if spheres overlap, by
  /// rounding alone; infinity if no two are near each other. O(n).
  double least_gap() const;

  /// Lets time pass up to the next collision, but not beyond `limit`: nothing is returned if that comes
  /// first.
  /// @throws InvalidParameter, changing nothing, if the limit is before now(), NaN or beyond kMaxMagnitude;
  ///   where a sphere with a restitution below 1 collides ever faster, so that time stands still (inelastic
  ///   collapse); CutoffTooLarge if spheres have grown too large for the box.
  std::optional<Collision> step(double limit);
  /// Steps up to a time. @throws as step().
  void advance_to(double time);

  /// From now on radii grow by this share of what they are now in each unit of time; walls that move give the
  /// spheres energy. @throws InvalidParameter if it is negative or not finite.
  void set_growth(double rate);
  /// Multiplies all velocities by a factor > 0. @throws InvalidParameter.
  void scale_velocities(double factor);
  /// Begins anew from where the spheres are: what is rounded from here on depends on positions, velocities
  /// and radii alone. O(n). It happens by itself after so many collisions that times stay small.
  void synchronize();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::kinetic
#pragma GCC visibility pop

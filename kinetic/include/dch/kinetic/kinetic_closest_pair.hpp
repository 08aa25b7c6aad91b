// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/kinetic/flight_plan.hpp>
#include <dch/kinetic/kinetic_edges.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// Another pair has become the closest one.
struct ClosestChange {
  double time = 0;
  Edge before, after;  ///< ids; -1 where there was none
};

using ClosestCallback = std::function<void(const ClosestChange&)>;

/// What a kinetic closest pair did and holds: the four qualities of a kinetic data structure, as counted.
struct ClosestCounters {
  std::int64_t changes = 0;      ///< of the closest pair, as reported: external events
  std::int64_t lost = 0;         ///< certificates that failed: events of the tournament
  std::int64_t edge_events = 0;  ///< pairs that came within the cutoff or left it
  std::int64_t cutoffs = 0;      ///< times that a cutoff was chosen, O(n) each
  std::int64_t looks_ahead =
      0;  ///< times that all pairs were looked at, where no two are within any cutoff, O(n^2)
  std::int64_t edges = 0;         ///< pairs in the tournament now
  std::int64_t certificates = 0;  ///< of the tournament now: fewer than edges
  std::int64_t made = 0;          ///< certificates made by all events and changes of plan
};

/// The closest pair of points whose motion is known, at every time (thesis 5.6.10): the pairs within a cutoff
/// as edges that come and go (make_kinetic_edges), and a kinetic tournament over them. Distances are those of
/// nearest images.
///
///     dch::kinetic::KineticClosestPair closest(box, plans, 0.0);
///     while (auto change = closest.step(end))
///       std::printf("%g: %d, %d\n", change->time, change->after.a, change->after.b);
///
/// Certificates say which of two pairs is the closer one, and hold until the polynomial that is the
/// difference of their squared distances changes its sign. Pairs that are equally close for a moment have no
/// event; of pairs that are so for good, as points that move alike are, the one with the smallest ids is
/// meant, as far as rounding tells. Events at one time are one change.
///
/// The cutoff is chosen by the distances of neighbors of some points, so that there are about as many edges
/// as points or fewer; when the last edge goes it is doubled, and when there are more than eight a point it
/// is chosen anew, by the positions alone, so that all is the same each time. Where no two points are within
/// kMaxShareOfBox of box.max_cutoff(), which takes few points or a long thin box, all pairs are looked
/// at, O(n^2), each time that a point has moved an eighth of half the smallest height.
///
/// Compact: fewer certificates than edges. Local: a point has part in O(degree lg n) certificates, with the
/// levels of the thesis's hierarchy O(lg alpha lg n) (erratum E19), not O(lg n + lg alpha). Responsive: O(lg
/// n) certificates an event. Efficient: O(n^2 lg n) events of the tournament for edges that come and go n^2
/// times. Not thread-safe.
///
/// What is thrown for arguments that do not fit changes nothing. If anything else is thrown by step(),
/// advance_to() or set_motion(), these throw InvalidParameter from then on.
class KineticClosestPair {
 public:
  /// @param plans begun at `start` or before
  /// @throws as make_kinetic_edges(), of a cutoff that it chooses itself: InvalidParameter and
  /// InvalidPosition for plans
  ///   that do not fit.
  KineticClosestPair(const Box& box, Span<const FlightPlan> plans, double start);
  ~KineticClosestPair();
  KineticClosestPair(KineticClosestPair&&) noexcept;
  KineticClosestPair& operator=(KineticClosestPair&&) noexcept;

  std::size_t size() const;
  const Box& box() const;
  /// The time up to which everything has happened.
  double now() const;
  const FlightPlan& plan(std::int32_t id) const;
  Vec3 position(std::int32_t id) const;

  /// The closest pair now, the smaller id first; -1 if there are fewer than two points.
  Edge pair() const;
  /// Its distance now; infinity if there is none [length].
  double distance() const;
  /// The largest distance of an edge now: pairs farther apart are not known [length].
  double cutoff() const;

  /// Gives a point another plan from now on, as KineticEdges::set_motion() does. Where pairs are equally
  /// close the closest pair may be another one by this, which the next step reports.
  void set_motion(std::int32_t id, Vec3 velocity, Vec3 acceleration = {});

  /// The closest pair is the same until this time, which is that of the next event inside the structure or
  /// outside; infinity if there will be none with the present plans.
  double next_event() const;

  /// Lets time pass until another pair is the closest one, which then has happened, but not beyond `limit`:
  /// nothing is returned if that comes first.
  /// @throws InvalidParameter, changing nothing, if the limit is before now(), NaN, or beyond kMaxMagnitude.
  std::optional<ClosestChange> step(double limit);

  /// Steps up to a time, calling `callback` after each change; it may call set_motion().
  /// @throws as step().
  void advance_to(double time, const ClosestCallback& callback = {});

  ClosestCounters counters() const;
  /// Locality: how many certificates of the tournament a point has part in.
  std::int64_t certificates_of(std::int32_t id) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch::kinetic
#pragma GCC visibility pop

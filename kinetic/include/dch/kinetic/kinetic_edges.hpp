// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/kinetic/flight_plan.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// Two points, the smaller id first.
struct Edge {
  std::int32_t a = -1, b = -1;

  friend bool operator==(const Edge& x, const Edge& y) { return x.a == y.a && x.b == y.b; }
  friend bool operator<(const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }
};

/// A pair comes within its distance or leaves it.
struct EdgeEvent {
  double time = 0;
  Edge edge;
  bool appears = false;  ///< else it vanishes

  /// The order of events: by time, then by ids.
  friend bool operator<(const EdgeEvent& x, const EdgeEvent& y) {
    return x.time != y.time ? x.time < y.time : x.edge < y.edge;
  }
};

using EdgeCallback = std::function<void(const EdgeEvent&)>;

struct KineticParams {
  Box box{};
  /// Distance of all pairs [length]; not looked at where there are radii.
  double cutoff = 0;
  /// If given, one for each point, > 0: the distance of a pair is the sum of both [length].
  std::vector<double> radii{};
};

/// Largest distance of a pair over box.max_cutoff(): the rest is room for motion between two searches.
inline constexpr double kMaxShareOfBox = 0.9;
inline constexpr double kLargestShareOfBox = kMaxShareOfBox;  ///< the name of before, for one version

/// The pairs of moving points within a distance of each other, at every time, and when each comes and goes:
/// the edges of level 0 of a kinetic DCH (thesis 5.5.1). Distances are those of nearest images.
///
///     auto edges = dch::kinetic::make_kinetic_edges(params, plans, 0.0);
///     while (auto event = edges->step(end)) {          // time passes up to the event
///       edges->set_motion(event->edge.a, after_a);     // as it does at a collision
///     }
///
/// A pair that touches its distance without crossing it has no event, and one that is at its distance counts
/// by where it is going (PairMotion). Events at the same time come in the order of their ids. Times are those
/// of the roots of the pair's own polynomial: the same whatever the history of the structure, so that all
/// implementations give the same events. Not thread-safe.
///
/// What is thrown for arguments that do not fit changes nothing. If anything else is thrown by step(),
/// advance_to() or set_motion(), as std::bad_alloc is, these throw InvalidParameter from then on.
class KineticEdges {
 public:
  virtual ~KineticEdges() = default;
  KineticEdges(const KineticEdges&) = delete;
  KineticEdges& operator=(const KineticEdges&) = delete;

  std::size_t size() const { return plans_.size(); }
  const Box& box() const { return params_.box; }
  /// The time up to which everything has happened.
  double now() const { return now_; }
  const FlightPlan& plan(std::int32_t id) const { return plans_[static_cast<std::size_t>(id)]; }
  Vec3 position(std::int32_t id) const { return position_at(plan(id), now_); }
  /// The distance of a pair that makes an edge [length].
  double distance(Edge edge) const;

  /// Gives a point another plan from now on; the plan's position is the image in the cell of where it is, as
  /// those of the plans given at the start are.
  /// Edges that come or go by this, as of spheres that touch and now fly apart, do so in the next step, at
  /// the present time.
  /// @throws InvalidParameter, changing nothing, for an id out of range or a component that is not finite or
  ///   beyond kMaxMagnitude.
  void set_motion(std::int32_t id, Vec3 velocity, Vec3 acceleration = {});

  /// No edge comes or goes before this time, which is that of the next event inside the structure or outside;
  /// infinity if there will be none with the present plans.
  virtual double next_event() const = 0;

  /// Lets time pass up to the next event of an edge, which then has happened, but not beyond `limit`: nothing
  /// is returned if that comes first.
  /// @throws InvalidParameter, changing nothing, if the limit is before now(), NaN, or beyond kMaxMagnitude.
  std::optional<EdgeEvent> step(double limit);

  /// Steps up to a time, calling `callback` after each event; it may call set_motion().
  /// @throws as step().
  void advance_to(double time, const EdgeCallback& callback = {});

  /// All edges now, ascending. O(edges).
  virtual std::vector<Edge> edges() const = 0;

 protected:
  KineticEdges(const KineticParams& params, Span<const FlightPlan> plans, double start);
  virtual std::optional<EdgeEvent> next_until(double limit) = 0;
  /// A point has been given another plan.
  virtual void follow(std::int32_t id) = 0;

  KineticParams params_;
  std::vector<FlightPlan> plans_;
  double now_;

 private:
  void begin_change();

  bool is_whole_ = true;  ///< whether no change has been broken off
};

/// For production: each point has a ball around its home, and a list of the pairs that can meet while both
/// points are in their balls (thesis 5.5.3, end: one expiry a point). A point that leaves its ball gets a new
/// home and a new list; once many have done so, all do, by the lists of a kept Hierarchy. An event or a
/// change of plan costs O(neighbors of the two points + lg n).
/// @param plans begun at `start` or before
/// @throws InvalidParameter for a cutoff or a radius out of range, radii that do not fit, plans that begin
/// after
///   `start`, and numbers that are not finite or beyond kMaxMagnitude; InvalidPosition; CutoffTooLarge if the
///   largest distance exceeds kMaxShareOfBox of box.max_cutoff().
std::unique_ptr<KineticEdges> make_kinetic_edges(const KineticParams& params, Span<const FlightPlan> plans,
                                                 double start);

}  // namespace dch::kinetic
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <dch/kinetic/hard_spheres.hpp>

#include "anchor_search.hpp"
#include "images.hpp"
#include "mutual_rows.hpp"
#include "simd/sphere_kernels.hpp"
#include "sphere_queue.hpp"

namespace dch::kinetic {

/// What HardSpheres does, for arguments that have been checked. Times are counted from the last
/// synchronize(), so that they stay small and round little.
class SphereEngine {
 public:
  SphereEngine(const HardSphereParams& params, Span<const Vec3> positions, Span<const Vec3> velocities);
  SphereEngine(const SphereEngine&) = delete;  // members refer to each other
  SphereEngine& operator=(const SphereEngine&) = delete;

  std::optional<Collision> step(double limit);
  /// Time of the clock becomes zero.
  void synchronize();
  void set_growth(double rate);
  void scale_velocities(double factor);

  double now() const { return now_; }
  double radius(std::int32_t id) const { return radius_at(sphere(id), now_); }
  Vec3 position(std::int32_t id) const;
  Vec3 velocity(std::int32_t id) const { return sphere(id).velocity; }
  double virial() const { return virial_; }
  const HardSphereCounters& counters() const { return counters_; }
  double least_gap() const;
  /// Whether enough has happened that synchronize() costs little.
  bool has_long_run() const;

 private:
  /// How far a sphere goes before it gets a new home or anchor, and what it did since it got one.
  struct Rooms {
    double home = 0, anchor = 0;  ///< [length]
    std::int32_t collisions = 0, homes = 0;
    double since = 0;          ///< when the sphere was last seen to collide at a usual rate
    std::int32_t hurried = 0;  ///< collisions since then
  };

  Flight& sphere(std::int32_t id) { return spheres_[static_cast<std::size_t>(id)]; }
  const Flight& sphere(std::int32_t id) const { return spheres_[static_cast<std::size_t>(id)]; }
  double scale_at(double time) const { return scale_ + growth_ * time; }
  double radius_at(const Flight& sphere, double time) const { return sphere.radius * scale_at(time); }

  void check_overlap(std::int32_t id) const;
  double find_contacts(std::int32_t id);
  SphereEvent next_of(std::int32_t id, double least) const;
  void fetch_partners(std::int32_t id) const;
  void predict(std::int32_t id);
  void predict_changed(std::int32_t id);
  void tell_partners(std::int32_t id);
  void tell_partner(std::int32_t partner, std::int32_t id, double time);
  void predict_all();
  void set_exit(std::int32_t id);
  Collision collide(std::int32_t a, std::int32_t b);
  void watch_for_collapse(std::int32_t id);

  void find_first_homes();
  void leave_home(std::int32_t id);
  void give_anchor(std::int32_t id);
  void search_for_anchor(std::int32_t id);
  bool give_all_anchors();
  void take_candidates(std::int32_t id);
  void set_ball(std::int32_t id);
  void join_near(std::int32_t id);
  double room_at_anchor(std::int32_t id) const;
  double most_room() const;

  const SphereKernels& kernels_;
  Images images_;
  NearestImages nearest_;
  double restitution_;
  double scale_ = 1, growth_ = 0;  ///< of all radii, at time zero, and in a unit of time
  double largest_radius_ = 0;      ///< as given at the start
  double now_ = 0;
  double usual_time_ = 0;  ///< in which spheres fly about their own size
  double virial_ = 0;
  std::int64_t collisions_at_zero_ = 0;
  std::vector<Flight> spheres_;
  std::vector<double> masses_;
  std::vector<Ball> homes_;
  std::vector<double> exits_;
  std::vector<Rooms> rooms_;
  MutualRows rows_;                  ///< whose balls around homes touch: the tracked pairs
  MutualRows candidates_;            ///< whose balls around anchors touch
  std::vector<std::int32_t> found_;  ///< a row that is being made
  std::vector<std::size_t> added_;   ///< places in it of partners that are new
  std::vector<double> times_;        ///< of contact with each of the row of the sphere that is predicted
  AnchorSearch anchors_;
  SphereQueue events_;
  HardSphereCounters counters_;
};

}  // namespace dch::kinetic

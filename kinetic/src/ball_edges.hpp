// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>
#include <dch/kinetic/pair_motion.hpp>

#include "home_search.hpp"
#include "images.hpp"
#include "point_queue.hpp"

namespace dch::kinetic {

/// The production engine. Each point has a home and stays in a ball around it until its exit. While two
/// points are in their balls they can only be an edge if their homes are within their distance and the radii
/// of both balls: the tracked pairs are all these.
class BallEdges : public KineticEdges {
 public:
  BallEdges(const KineticParams& params, Span<const FlightPlan> plans, double start);

  double next_event() const override;
  std::vector<Edge> edges() const override;

 protected:
  std::optional<EdgeEvent> next_until(double limit) override;
  void follow(std::int32_t id) override;

 private:
  struct Pair {
    Edge edge;
    bool is_within = false;
    double time = kNever;  ///< of the next crossing
  };

  void give_all_homes();
  void give_home(std::int32_t id);
  void leave_ball(std::int32_t id);
  void set_exit(std::int32_t id);
  std::vector<Edge> choose_ball(std::int32_t id);
  std::vector<Edge> near_home(std::int32_t id);
  bool are_near(Edge edge) const;

  PairMotion motion(Edge edge) const;
  void predict(Pair& pair);
  void set_next(std::int32_t id);
  std::int32_t track(Edge edge);
  void drop(std::int32_t k);
  Pair& pair(std::int32_t k) { return pairs_[static_cast<std::size_t>(k)]; }
  std::vector<std::int32_t>& pairs_of(std::int32_t id) { return pairs_of_[static_cast<std::size_t>(id)]; }
  std::int32_t partner(std::int32_t k, std::int32_t id) const;

  Images images_;
  double room_;       ///< radius of the balls when all points get a home [length]
  double most_room_;  ///< and at most [length]
  HomeSearch search_;
  std::vector<FlightPlan> homes_;     ///< at rest
  std::vector<double> rooms_;         ///< by point: the radius of its ball [length]
  std::vector<std::int32_t> strays_;  ///< who got a home since all did
  std::vector<bool> is_stray_;        ///< by point
  std::vector<Pair> pairs_;
  std::vector<std::int32_t> free_pairs_;
  std::vector<std::vector<std::int32_t>> pairs_of_;  ///< by point, of both points of a pair
  std::vector<std::int32_t> found_;  ///< by point: its pair with the point at hand, -1 for none
  PointQueue events_;                ///< by the first point of a pair
  PointQueue exits_;
};

}  // namespace dch::kinetic

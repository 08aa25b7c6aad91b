// SPDX-License-Identifier: MIT
#include "ball_edges.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "largest_distance.hpp"

namespace dch::kinetic {
namespace {

/// Room over the mean distance of a pair: more room, fewer searches, but longer lists.
constexpr double kRoom = 0.2;
/// Exits are taken this share of the room early, which is far more than roots and distances round.
constexpr double kEarly = 1e-6;
/// How many points may have homes of their own, beyond a share of all.
constexpr std::size_t kStrays = 64, kPointsPerStray = 64;
/// Of the room of a point that has met nobody; and how many others it may have near it then.
constexpr double kGrowth = 4;
constexpr std::size_t kCrowd = 32;

/// With two points in their balls and tracked, the image that is meant stays the nearest one.
double choose_most_room(const KineticParams& params) {
  return 0.24 * (params.box.max_cutoff() - largest_distance(params));
}

double choose_room(const KineticParams& params) {
  double mean = params.cutoff;
  if (!params.radii.empty())
    mean = 2 * std::accumulate(params.radii.begin(), params.radii.end(), 0.0) /
           static_cast<double>(params.radii.size());
  return std::min(kRoom * mean, choose_most_room(params));
}

}  // namespace

BallEdges::BallEdges(const KineticParams& params, Span<const FlightPlan> plans, double start)
    : KineticEdges(params, plans, start),
      images_(params.box),
      room_(choose_room(params)),
      most_room_(choose_most_room(params)),
      search_(params_, largest_distance(params), 2 * room_),
      homes_(plans.size()),
      is_stray_(plans.size(), false),
      pairs_of_(plans.size()),
      found_(plans.size(), -1),
      events_(plans.size()),
      exits_(plans.size()) {
  give_all_homes();
  for (Pair& pair : pairs_) {
    pair.is_within = motion(pair.edge).is_within_after(now_);
    predict(pair);
  }
  for (std::size_t i = 0; i < size(); ++i) set_next(static_cast<std::int32_t>(i));
}

double BallEdges::next_event() const {
  if (events_.empty()) return kNever;
  return std::min(events_.top().time, exits_.top().time);
}

std::vector<Edge> BallEdges::edges() const {
  std::vector<Edge> edges;
  for (const Pair& pair : pairs_)
    if (pair.is_within) edges.push_back(pair.edge);
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::optional<EdgeEvent> BallEdges::next_until(double limit) {
  while (next_event() <= limit) {
    now_ = next_event();
    if (exits_.top().time == now_) {
      leave_ball(exits_.top().edge.a);
      continue;
    }
    Pair& next = pair(events_.top().pair);
    next.is_within = !next.is_within;
    next.time = motion(next.edge).next_crossing(now_, next.is_within);
    const EdgeEvent event{now_, next.edge, next.is_within};
    set_next(event.edge.a);
    return event;
  }
  now_ = limit;
  return std::nullopt;
}

void BallEdges::follow(std::int32_t id) {
  for (const std::int32_t k : pairs_of(id)) {
    predict(pair(k));
    const std::int32_t first = pair(k).edge.a;
    if (first == id) continue;
    const Due due{pair(k).time, pair(k).edge, k};
    if (due < events_.of(first)) {
      events_.set(first, due);
    } else if (events_.of(first).pair == k) {
      set_next(first);
    }
  }
  set_next(id);
  set_exit(id);
}

void BallEdges::leave_ball(std::int32_t id) {
  if (is_stray_[static_cast<std::size_t>(id)] || strays_.size() < kStrays + size() / kPointsPerStray) {
    give_home(id);
  } else {
    give_all_homes();
  }
}

/// Pairs that were tracked before stay as they are.
void BallEdges::give_all_homes() {
  std::vector<Vec3> at(size());
  for (std::size_t i = 0; i < size(); ++i) {
    at[i] = box().wrap(position(static_cast<std::int32_t>(i)));
    homes_[i] = {now_, at[i], {}, {}};
  }
  strays_.clear();
  rooms_.assign(size(), room_);
  is_stray_.assign(size(), false);
  const NeighborList& list = search_.find_all(at);
  std::vector<std::vector<std::int32_t>> before(size());
  pairs_of_.swap(before);
  const std::vector<Pair> old = std::move(pairs_);
  pairs_.clear();
  free_pairs_.clear();
  const auto points = static_cast<std::int32_t>(size());
  for (std::int32_t a = 0; a < points; ++a) {
    const auto& pairs_before = before[static_cast<std::size_t>(a)];
    const auto mark = [&](bool is_known) {
      for (const std::int32_t k : pairs_before) {
        const Edge edge = old[static_cast<std::size_t>(k)].edge;
        if (edge.a == a) found_[static_cast<std::size_t>(edge.b)] = is_known ? k : -1;
      }
    };
    mark(true);
    for (const std::int32_t b : list.row(static_cast<std::size_t>(a))) {
      const std::int32_t known = found_[static_cast<std::size_t>(b)];
      if (known < 0) {
        track({a, b});
      } else {
        pairs_of(a).push_back(static_cast<std::int32_t>(pairs_.size()));
        pairs_of(b).push_back(static_cast<std::int32_t>(pairs_.size()));
        pairs_.push_back(old[static_cast<std::size_t>(known)]);
      }
    }
    mark(false);
  }
  for (std::int32_t id = 0; id < points; ++id) {
    set_next(id);
    set_exit(id);
  }
}

void BallEdges::give_home(std::int32_t id) {
  const auto self = static_cast<std::size_t>(id);
  homes_[self] = {now_, box().wrap(position(id)), {}, {}};
  if (!is_stray_[self]) strays_.push_back(id);
  is_stray_[self] = true;
  const std::vector<Edge> near = choose_ball(id);
  const std::vector<std::int32_t> before = pairs_of(id);
  for (const std::int32_t k : before) {
    if (are_near(pair(k).edge)) {
      found_[static_cast<std::size_t>(partner(k, id))] = k;
      continue;
    }
    const std::int32_t first = pair(k).edge.a;
    drop(k);
    if (events_.of(first).pair == k) set_next(first);
  }
  for (const Edge edge : near) {
    std::int32_t& known = found_[static_cast<std::size_t>(edge.a == id ? edge.b : edge.a)];
    if (known >= 0) continue;
    known = track(edge);
    const Due due{pair(known).time, edge, known};
    if (due < events_.of(edge.a)) events_.set(edge.a, due);
  }
  for (const std::int32_t k : pairs_of(id)) found_[static_cast<std::size_t>(partner(k, id))] = -1;
  set_exit(id);
}

/// A point that has met nobody gets more room each time, so that it crosses empty space in few steps.
std::vector<Edge> BallEdges::choose_ball(std::int32_t id) {
  double& room = rooms_[static_cast<std::size_t>(id)];
  room = pairs_of(id).empty() ? std::min(kGrowth * room, most_room_) : room_;
  std::vector<Edge> near = near_home(id);
  while (near.size() > kCrowd && room > room_) {
    room = std::max(room_, room / (kGrowth * kGrowth));
    near = near_home(id);
  }
  return near;
}

/// All pairs of a point with others whose homes are near enough.
std::vector<Edge> BallEdges::near_home(std::int32_t id) {
  std::vector<Edge> near;
  const auto look_at = [&](std::int32_t other) {
    const Edge edge{std::min(id, other), std::max(id, other)};
    if (other != id && are_near(edge)) near.push_back(edge);
  };
  const auto self = static_cast<std::size_t>(id);
  const double widest =
      params_.radii.empty() ? params_.cutoff : params_.radii[self] + 0.5 * largest_distance(params_);
  search_.find_near(homes_[self].position, widest + rooms_[self] + room_, [&](std::int32_t other) {
    if (!is_stray_[static_cast<std::size_t>(other)]) look_at(other);
  });
  for (const std::int32_t other : strays_) look_at(other);
  return near;
}

bool BallEdges::are_near(Edge edge) const {
  const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
  const double reach = distance(edge) + rooms_[a] + rooms_[b];
  return box().distance2(homes_[a].position, homes_[b].position) <= reach * reach;
}

/// The first time at which the point is at the edge of its ball; later than now even where the time that it
/// takes is below the rounding of times.
void BallEdges::set_exit(std::int32_t id) {
  const FlightPlan& home = homes_[static_cast<std::size_t>(id)];
  const Vec3 shift = images_.to_nearest(position(id) - home.position);
  const PairMotion away(home, plan(id), shift, rooms_[static_cast<std::size_t>(id)] * (1 - kEarly));
  double exit = now_;
  if (home.time == now_ || away.is_within_after(now_))
    exit = std::max(away.next_crossing(now_, true), home.time == now_ ? std::nextafter(now_, kNever) : now_);
  exits_.set(id, {exit, {id, -1}});
}

/// A polynomial of the plans and of the image that is nearest now.
PairMotion BallEdges::motion(Edge edge) const {
  const Vec3 shift = images_.to_nearest(position(edge.b) - position(edge.a));
  return {plan(edge.a), plan(edge.b), shift, distance(edge)};
}

/// A pair that is not where it is said to be crosses its distance at once.
void BallEdges::predict(Pair& pair) {
  const PairMotion moves = motion(pair.edge);
  pair.time =
      moves.is_within_after(now_) == pair.is_within ? moves.next_crossing(now_, pair.is_within) : now_;
}

void BallEdges::set_next(std::int32_t id) {
  Due next{kNever, {id, -1}};
  for (const std::int32_t k : pairs_of(id)) {
    if (pair(k).edge.a != id) continue;
    const Due due{pair(k).time, pair(k).edge, k};
    if (due < next) next = due;
  }
  events_.set(id, next);
}

std::int32_t BallEdges::track(Edge edge) {
  auto k = static_cast<std::int32_t>(pairs_.size());
  if (free_pairs_.empty()) {
    pairs_.push_back({});
  } else {
    k = free_pairs_.back();
    free_pairs_.pop_back();
  }
  pair(k) = {edge};
  predict(pair(k));
  pairs_of(edge.a).push_back(k);
  pairs_of(edge.b).push_back(k);
  return k;
}

void BallEdges::drop(std::int32_t k) {
  const Edge edge = pair(k).edge;
  assert(!pair(k).is_within);
  for (const std::int32_t id : {edge.a, edge.b}) {
    std::vector<std::int32_t>& pairs = pairs_of(id);
    *std::find(pairs.begin(), pairs.end(), k) = pairs.back();
    pairs.pop_back();
  }
  pair(k) = {};
  free_pairs_.push_back(k);
}

std::int32_t BallEdges::partner(std::int32_t k, std::int32_t id) const {
  const Edge edge = pairs_[static_cast<std::size_t>(k)].edge;
  return edge.a == id ? edge.b : edge.a;
}

std::unique_ptr<KineticEdges> make_kinetic_edges(const KineticParams& params, Span<const FlightPlan> plans,
                                                 double start) {
  return std::make_unique<BallEdges>(params, plans, start);
}

}  // namespace dch::kinetic

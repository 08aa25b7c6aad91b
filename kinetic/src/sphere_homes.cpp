// SPDX-License-Identifier: MIT
//
// Where spheres stay until their exits, and whom they may meet until then.
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "sphere_engine.hpp"
#include "sphere_motion.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

/// Of a sphere's radius: the first guess of its room around its home, and around its anchor.
constexpr double kHomeRoom = 0.4, kAnchorRoom = 1.2;
/// Room around a home below this share of the radius makes no list shorter.
constexpr double kMinRoom = 0.02;
/// What it costs in predictions of a pair to look at a candidate, to give a home, the same for each of its
/// pairs with candidates about four times as many, and to search for a place.
constexpr double kLook = 0.5, kHome = 10, kPairOfHome = 3, kSearch = 500;
/// And for a sphere's share of what it costs to list the candidates of all.
constexpr double kShareOfList = 40;
/// A room changes by this share for each share that its use is off; and by how much it is widened where
/// nobody is near.
constexpr double kGain = 0.1, kMaxShare = 4, kLeap = 1.4;
/// Balls that touch so many others are not widened.
constexpr double kCrowd = 64, kCrowdOfAnchor = 60;
/// Exits are taken this share of the room early, which is far more than roots and distances round.
constexpr double kEarly = 1e-6;

/// The cost of lists is least where what is done with a list costs as much as to make it, times the exponent
/// by which the room lasts longer over that by which the list grows, about 1.5 over 3 room / (radius + room).
/// @param touching how many others the ball touched
void adapt(double& room, double radius, double use, double cost, double touching, double crowd) {
  const double share = use / (cost * (radius + room) / (2 * room));
  if (share > 1 || touching <= crowd) room *= 1 + kGain * (1 - std::min(share, kMaxShare));
  if (touching == 0) room *= kLeap;
}

}  // namespace

/// With two spheres in balls that touch, the image that is meant stays the nearest one.
double SphereEngine::most_room() const {
  const double diameter = 2 * largest_radius_ * scale_at(now_), limit = images_.box().max_cutoff();
  if (diameter > kMaxShareOfBox * limit)
    throw CutoffTooLarge("the largest diameter = " + describe(diameter) + " exceeds " +
                         describe(kMaxShareOfBox * limit) + ", " + describe(kMaxShareOfBox) +
                         " of half the smallest height of the periodic box; stop the growth sooner, or take "
                         "more spheres");
  return std::min(0.24 * (limit - diameter), kMaxListRadius / 16);
}

void SphereEngine::find_first_homes() {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Flight& s = spheres_[i];
    rooms_[i].home = kHomeRoom * s.radius;
    rooms_[i].anchor = kAnchorRoom * s.radius;
    balls.push_back({s.position, s.radius + rooms_[i].anchor});
  }
  anchors_.set_all(balls);
  const auto spheres = static_cast<std::int32_t>(spheres_.size());
  for (std::int32_t id = 0; id < spheres; ++id) {
    anchors_.find_touching(id, found_);
    check_overlap(id);
    take_candidates(id);
    set_ball(id);
  }
  for (std::int32_t id = 0; id < spheres; ++id) join_near(id);
}

/// Before anything is made of the pair: of spheres on one spot each would have all others in its row.
void SphereEngine::check_overlap(std::int32_t id) const {
  const Flight& self = sphere(id);
  std::int32_t first = -1;
  for (const std::int32_t other : found_) {
    const double distance = (self.radius + sphere(other).radius) * (1 - kTouching);
    if (images_.box().distance2(self.position, sphere(other).position) < distance * distance &&
        (first < 0 || other < first))
      first = other;
  }
  if (first < 0) return;
  const double apart = std::sqrt(images_.box().distance2(self.position, sphere(first).position));
  throw InvalidParameter("spheres " + std::to_string(id) + " and " + std::to_string(first) +
                         " overlap: their centers are " + describe(apart) +
                         " apart, and their radii add up to " + describe(self.radius + sphere(first).radius) +
                         "; move them apart, or begin with smaller radii and let them grow");
}

void SphereEngine::leave_home(std::int32_t id) {
  Rooms& rooms = rooms_[static_cast<std::size_t>(id)];
  const auto pairs = static_cast<double>(rows_.of(id).size());
  adapt(rooms.home, radius(id), rooms.collisions * pairs, kHome + kPairOfHome * pairs, pairs, kCrowd);
  rooms.collisions = 0;
  rooms.home = std::clamp(rooms.home, std::min(kMinRoom * radius(id), most_room()), most_room());
  ++counters_.homes;
  ++rooms.homes;
  if (room_at_anchor(id) < 0.5 * rooms.home) give_anchor(id);
  set_ball(id);
  join_near(id);
  set_exit(id);
  fetch_partners(id);
  const SphereEvent next = next_of(id, find_contacts(id));
  for (const std::size_t place : added_) tell_partner(rows_.of(id)[place], id, times_[place]);
  events_.set(id, next);
}

/// What is left around the sphere of the ball around its anchor.
double SphereEngine::room_at_anchor(std::int32_t id) const {
  const Ball& anchor = anchors_.ball(id);
  return anchor.radius - radius(id) - std::sqrt(images_.box().distance2(anchor.center, position(id)));
}

void SphereEngine::set_ball(std::int32_t id) {
  const double room = std::min(rooms_[static_cast<std::size_t>(id)].home, room_at_anchor(id));
  homes_[static_cast<std::size_t>(id)] = {position(id), radius(id) + std::min(room, most_room())};
}

/// Where many have left their anchors since all got theirs, all get new ones.
void SphereEngine::give_anchor(std::int32_t id) {
  if (anchors_.has_many_strays()) {
    if (give_all_anchors()) return;
    anchors_.refresh();
  }
  search_for_anchor(id);
}

/// One list has the candidates of all, at far less than a search for each would cost. Returns whether the box
/// is wide enough for that.
bool SphereEngine::give_all_anchors() {
  const double widest = anchors_.widest_to_list();
  std::vector<Ball> balls;
  std::vector<double> anchor_rooms;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const Rooms& rooms = rooms_[i];
    const auto candidates = static_cast<double>(candidates_.of(id).size());
    double room = rooms.anchor;
    adapt(room, radius(id), rooms.homes * kLook * candidates, kShareOfList + candidates, candidates,
          kCrowdOfAnchor);
    room = std::max(1.5 * rooms.home, std::min(room, widest - radius(id)));
    // The ball around the home, which stays, is in that around the anchor.
    const double home = std::sqrt(images_.box().distance2(homes_[i].center, position(id))) + homes_[i].radius;
    balls.push_back({position(id), std::max(home, radius(id) + room)});
    if (balls.back().radius > widest) return false;
    anchor_rooms.push_back(room);
  }
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    rooms_[i].anchor = anchor_rooms[i];
    rooms_[i].homes = 0;
  }
  anchors_.set_all(balls);
  candidates_.replace_all(anchors_.find_all_touching());
  return true;
}

void SphereEngine::search_for_anchor(std::int32_t id) {
  Rooms& rooms = rooms_[static_cast<std::size_t>(id)];
  const auto candidates = static_cast<double>(candidates_.of(id).size());
  adapt(rooms.anchor, radius(id), rooms.homes * kLook * candidates, kSearch + candidates, candidates,
        kCrowdOfAnchor);
  rooms.homes = 0;
  rooms.anchor = std::clamp(rooms.anchor, 1.5 * rooms.home, kMaxListRadius / 16);
  anchors_.set(id, {position(id), radius(id) + rooms.anchor});
  ++counters_.anchors;
  anchors_.find_touching(id, found_);
  take_candidates(id);
}

void SphereEngine::take_candidates(std::int32_t id) {
  candidates_.replace(
      id, found_, [](std::size_t) {}, [](std::int32_t) {});
}

/// Makes the row of those whose balls touch, and that of places in it whose partners are new.
void SphereEngine::join_near(std::int32_t id) {
  const std::vector<std::int32_t>& candidates = candidates_.of(id);
  found_.resize(candidates.size() + kMostLanes);
  found_.resize(kernels_.find_touching(homes_.data(), id, candidates.data(), candidates.size(), nearest_,
                                       found_.data()));
  added_.clear();
  rows_.replace(
      id, found_, [&](std::size_t place) { added_.push_back(place); },
      [&](std::int32_t other) {
        if (events_.of(other).partner == id) events_.doubt(other);
      });
}

/// Later than now even where the time that the sphere takes is below the rounding of times.
void SphereEngine::set_exit(std::int32_t id) {
  const Flight& s = sphere(id);
  const Ball& home = homes_[static_cast<std::size_t>(id)];
  const Vec3 off = images_.box().nearest_image(s.position + (now_ - s.time) * s.velocity - home.center);
  const double room = (home.radius - radius(id)) * (1 - kEarly);
  const double stay = time_to_exit(off, s.velocity, room, -growth_ * s.radius);
  exits_[static_cast<std::size_t>(id)] = std::max(now_ + stay, std::nextafter(now_, kNever));
}

}  // namespace dch::kinetic

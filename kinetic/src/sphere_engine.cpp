// SPDX-License-Identifier: MIT
#include "sphere_engine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"

namespace dch::kinetic {
namespace {

using detail::describe;

/// A run without synchronize() is this many collisions for each sphere.
constexpr std::int64_t kCollisionsOfRun = 32;
/// A sphere collapses that has had so many collisions within this share of the time in which it flies its own
/// size.
constexpr std::int32_t kHurried = 20;
constexpr double kUsualShare = 1e-5;
/// Of a relative speed: where rounding has spheres touch that pass each other, this much parts them.
constexpr double kMinApproach = 1e-15;

}  // namespace

SphereEngine::SphereEngine(const HardSphereParams& params, Span<const Vec3> positions,
                           Span<const Vec3> velocities)
    : kernels_(sphere_kernels(instruction_set())),
      images_(params.box),
      nearest_(images_),
      restitution_(params.restitution),
      masses_(params.masses),
      homes_(positions.size()),
      exits_(positions.size(), kNever),
      rooms_(positions.size()),
      rows_(positions.size()),
      candidates_(positions.size()),
      anchors_(params.box, kernels_, nearest_),
      events_(positions.size()) {
  if (masses_.empty()) masses_.assign(positions.size(), 1.0);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    spheres_.push_back({params.box.wrap(positions[i]), 0, velocities[i], params.radii[i]});
    largest_radius_ = std::max(largest_radius_, params.radii[i]);
  }
  find_first_homes();
  synchronize();
}

Vec3 SphereEngine::position(std::int32_t id) const {
  const Flight& s = sphere(id);
  return images_.box().wrap(s.position + (now_ - s.time) * s.velocity);
}

bool SphereEngine::has_long_run() const {
  return counters_.collisions - collisions_at_zero_ >=
         kCollisionsOfRun * static_cast<std::int64_t>(spheres_.size());
}

void SphereEngine::synchronize() {
  double speed2 = 0, size = 0;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    Flight& s = spheres_[i];
    s.position = position(static_cast<std::int32_t>(i));
    s.time = 0;
    rooms_[i].since -= now_;
    speed2 += norm2(s.velocity);
    size += radius_at(s, now_);
  }
  scale_ = scale_at(now_);
  now_ = 0;
  usual_time_ = speed2 > 0 ? size / std::sqrt(static_cast<double>(spheres_.size()) * speed2) : kNever;
  collisions_at_zero_ = counters_.collisions;
  predict_all();
}

void SphereEngine::set_growth(double rate) {
  growth_ = rate * scale_at(now_);
  predict_all();
}

void SphereEngine::scale_velocities(double factor) {
  for (Flight& s : spheres_) s.velocity = factor * s.velocity;
  predict_all();
}

void SphereEngine::predict_all() {
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    set_exit(static_cast<std::int32_t>(i));
    predict(static_cast<std::int32_t>(i));
  }
}

std::optional<Collision> SphereEngine::step(double limit) {
  while (!events_.empty() && events_.top().time <= limit) {
    const std::int32_t id = events_.winner();
    const SphereEvent next = events_.top();
    now_ = next.time;
    if (next.is_doubtful) {
      predict(id);
    } else if (next.partner < 0) {
      leave_home(id);
    } else {
      return collide(id, next.partner);
    }
  }
  now_ = limit;
  return std::nullopt;
}

/// Looks at all first without branches: most are told nothing.
void SphereEngine::tell_partners(std::int32_t id) {
  const std::vector<std::int32_t>& row = rows_.of(id);
  for (std::size_t first = 0; first < row.size(); first += 64) {
    const std::size_t last = std::min(first + 64, row.size());
    std::uint64_t told = 0;
    for (std::size_t k = first; k < last; ++k) {
      const SphereEvent& known = events_.of(row[k]);
      const int concerns = int{times_[k] <= known.time} | int{known.partner == id};
      told |= static_cast<std::uint64_t>(concerns) << (k - first);
    }
    for (; told != 0; told &= told - 1) {
      const std::size_t k = first + static_cast<std::size_t>(__builtin_ctzll(told));
      tell_partner(row[k], id, times_[k]);
    }
  }
}

/// Has the flights of partners and what is next for them on their way before the first one is needed.
void SphereEngine::fetch_partners(std::int32_t id) const {
  for (const std::int32_t other : rows_.of(id)) {
    __builtin_prefetch(&sphere(other));
    __builtin_prefetch(&events_.of(other));
  }
}

/// Writes the times of contact with all partners, and returns the least.
double SphereEngine::find_contacts(std::int32_t id) {
  const std::vector<std::int32_t>& row = rows_.of(id);
  times_.resize(row.size() + kMostLanes);
  counters_.predictions += static_cast<std::int64_t>(row.size());
  return kernels_.contact_times(spheres_.data(), id, row.data(), row.size(), nearest_,
                                {now_, scale_, growth_}, times_.data());
}

/// The exit or the contact whose time is the least of those that were found.
SphereEvent SphereEngine::next_of(std::int32_t id, double least) const {
  SphereEvent next{exits_[static_cast<std::size_t>(id)]};
  if (!(least < next.time)) return next;
  next.time = least;
  const std::vector<std::int32_t>& row = rows_.of(id);
  for (std::size_t k = 0; k < row.size(); ++k)
    if (times_[k] == least && (next.partner < 0 || row[k] < next.partner)) next.partner = row[k];
  return next;
}

/// What is next for a sphere, with its tracked pairs as they are.
void SphereEngine::predict(std::int32_t id) {
  fetch_partners(id);
  events_.set(id, next_of(id, find_contacts(id)));
}

/// The same for a sphere with a new flight, which its partners are told.
void SphereEngine::predict_changed(std::int32_t id) {
  const SphereEvent next = next_of(id, find_contacts(id));
  tell_partners(id);
  events_.set(id, next);
}

/// A partner whose next collision was with the sphere keeps its entry as a time before which nothing happens
/// to it: often it has another flight before then.
void SphereEngine::tell_partner(std::int32_t partner, std::int32_t id, double time) {
  const SphereEvent event{time, id};
  const SphereEvent& known = events_.of(partner);
  if (event.is_before(known)) {
    events_.set(partner, event);
  } else if (known.partner == id) {
    events_.doubt(partner);
  }
}

Collision SphereEngine::collide(std::int32_t a, std::int32_t b) {
  Flight &p = sphere(a), &q = sphere(b);
  fetch_partners(a);
  fetch_partners(b);
  for (const std::int32_t id : {a, b}) {
    const Vec3 at = position(id);
    sphere(id).position = at;
    sphere(id).time = now_;
    ++rooms_[static_cast<std::size_t>(id)].collisions;
  }
  const Vec3 apart = images_.box().nearest_image(q.position - p.position);
  const double distance = std::sqrt(norm2(apart));
  const Vec3 normal = (1 / distance) * apart;
  const Vec3 relative = q.velocity - p.velocity;
  const double approach = growth_ * (p.radius + q.radius) - dot(relative, normal);
  const double first = masses_[static_cast<std::size_t>(a)], second = masses_[static_cast<std::size_t>(b)];
  const double change = (1 + restitution_) * std::max(approach, kMinApproach * std::sqrt(norm2(relative)));
  p.velocity = p.velocity - (change * second / (first + second)) * normal;
  q.velocity = q.velocity + (change * first / (first + second)) * normal;
  const double impulse = change * first / (first + second) * second;
  virial_ += impulse * distance;
  ++counters_.collisions;
  for (const std::int32_t id : {a, b}) {
    if (restitution_ < 1) watch_for_collapse(id);
    set_exit(id);
  }
  predict_changed(a);
  predict_changed(b);
  return {now_, {std::min(a, b), std::max(a, b)}, impulse};
}

void SphereEngine::watch_for_collapse(std::int32_t id) {
  Rooms& rooms = rooms_[static_cast<std::size_t>(id)];
  if (now_ - rooms.since > kUsualShare * usual_time_) {
    rooms.since = now_;
    rooms.hurried = 0;
  } else if (++rooms.hurried > kHurried) {
    throw InvalidParameter(
        "sphere " + std::to_string(id) + " has collided " + std::to_string(kHurried) + " times within " +
        describe(now_ - rooms.since) + ", less than " + describe(kUsualShare) +
        " of the time in which a sphere flies its own size: with a restitution of " + describe(restitution_) +
        " they collapse, and time stands still; choose a restitution nearer to 1");
  }
}

double SphereEngine::least_gap() const {
  double least = kNever;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const auto a = static_cast<std::int32_t>(i);
    for (const std::int32_t b : rows_.of(a))
      if (b > a)
        least = std::min(
            least,
            std::sqrt(images_.box().distance2(position(a), position(b))) / (radius(a) + radius(b)) - 1);
  }
  return least;
}

}  // namespace dch::kinetic

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy_params.hpp>
#include <dch/kinetic/kinetic_closest_pair.hpp>

#include "argument_checks.hpp"
#include "base/describe.hpp"
#include "images.hpp"
#include "pair_tournament.hpp"
#include "sparse_pairs.hpp"

namespace dch::kinetic {
namespace {

/// Points whose nearest neighbors a cutoff goes by, and the share of them that have one within it.
constexpr std::size_t kSamples = 64, kShareNear = 8;
/// Over that distance.
constexpr double kRoom = 1.1;
/// A cutoff is chosen anew with more edges than these, beyond so many a point.
constexpr std::size_t kManyEdges = 64, kManyEdgesOfPoint = 8;
/// Searches add room for motion to a cutoff.
constexpr double kMaxCutoff = 0.01 * kMaxListRadius;

/// A distance within which the share of points kShareNear have a neighbor, by a sample of them.
double sample_neighbor_distance(const Box& box, const std::vector<FlightPlan>& plans, double now) {
  std::vector<Vec3> at;
  at.reserve(plans.size());
  for (const FlightPlan& plan : plans) at.push_back(box.wrap(position_at(plan, now)));
  const std::size_t samples = std::min(kSamples, at.size());
  std::vector<double> nearest2(samples, kNever);
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t self = k * at.size() / samples;
    for (std::size_t other = 0; other < at.size(); ++other)
      if (other != self) nearest2[k] = std::min(nearest2[k], box.distance2(at[self], at[other]));
  }
  const auto of_share = nearest2.begin() + static_cast<std::ptrdiff_t>(samples / kShareNear);
  std::nth_element(nearest2.begin(), of_share, nearest2.end());
  // Where points coincide, the smallest distance that there is
  double least2 = *of_share;
  if (least2 == 0)
    for (const Vec3 p : at)
      if (const double d2 = box.distance2(at[0], p); d2 > 0 && (least2 == 0 || d2 < least2)) least2 = d2;
  return std::sqrt(least2);
}

}  // namespace

struct KineticClosestPair::Impl {
  Impl(const Box& box, Span<const FlightPlan> plans, double start)
      : images(box),
        largest_cutoff(std::min(kMaxShareOfBox * box.max_cutoff(), kMaxCutoff)),
        slots_of(plans.size()) {
    check_plans(plans, start, box);
    choose_cutoff(std::vector<FlightPlan>(plans.begin(), plans.end()), start, 0);
    reported = tournament.closest();
  }

  // What the pairs are
  void choose_cutoff(const std::vector<FlightPlan>& plans, double now, double least);
  void load_edges();
  void load_sparse();
  void clear_pairs();
  void take(const EdgeEvent& event);
  void add(const PairTournament::Contender& contender);
  void remove(Edge edge);
  PairPath path(Edge edge) const;
  std::vector<FlightPlan> plans() const;

  // Time
  std::optional<ClosestChange> next_until(double limit);
  double next_event() const {
    if (has_change()) return edges->now();
    return std::min({edges->next_event(), tournament.next(), horizon});
  }
  bool has_change() const { return !(tournament.closest() == reported); }
  void follow(std::int32_t id);
  void begin_change();
  std::vector<std::int32_t>& slots(std::int32_t id) { return slots_of[static_cast<std::size_t>(id)]; }

  Images images;
  double largest_cutoff;
  double cutoff = 0;
  std::size_t most_edges = 0;  ///< with more of them a cutoff is chosen anew
  std::unique_ptr<KineticEdges> edges;
  PairTournament tournament;
  std::vector<std::vector<std::int32_t>> slots_of;  ///< by point
  bool is_sparse = false;                           ///< no edges, but all pairs that may be the closest one
  double horizon = kNever;                          ///< until then
  Edge reported;
  ClosestCounters counters;
  bool is_whole = true;
};

/// From a sample on by doubling, until there is an edge.
/// @param least at least this long [length]
void KineticClosestPair::Impl::choose_cutoff(const std::vector<FlightPlan>& plans, double now, double least) {
  ++counters.cutoffs;
  double wanted = 1;
  if (plans.size() > 1) wanted = std::max(kRoom * sample_neighbor_distance(images.box(), plans, now), least);
  clear_pairs();
  KineticParams params;
  params.box = images.box();
  for (bool is_last = false; tournament.empty() && !is_last; wanted *= 2) {
    cutoff = std::clamp(wanted, std::min(kMinListRadius, largest_cutoff), largest_cutoff);
    is_last = cutoff == largest_cutoff || plans.size() < 2;
    params.cutoff = cutoff;
    edges = make_kinetic_edges(params, plans, now);
    load_edges();
  }
  most_edges = std::max(kManyEdges + kManyEdgesOfPoint * plans.size(), 2 * tournament.size());
  if (tournament.empty()) load_sparse();
}

void KineticClosestPair::Impl::clear_pairs() {
  tournament.clear();
  for (std::vector<std::int32_t>& slots_of_point : slots_of) slots_of_point.clear();
  is_sparse = false;
  horizon = kNever;
}

void KineticClosestPair::Impl::load_edges() {
  clear_pairs();
  for (const Edge edge : edges->edges()) add({edge, path(edge)});
}

void KineticClosestPair::Impl::load_sparse() {
  clear_pairs();
  if (edges->size() < 2) return;
  is_sparse = true;
  ++counters.looks_ahead;
  const SparsePairs sparse = find_sparse_pairs(images, plans(), edges->now());
  for (const PairTournament::Contender& contender : sparse.contenders) add(contender);
  horizon = std::max(sparse.horizon, std::nextafter(edges->now(), kNever));
}

std::vector<FlightPlan> KineticClosestPair::Impl::plans() const {
  std::vector<FlightPlan> all;
  for (std::size_t id = 0; id < edges->size(); ++id)
    all.push_back(edges->plan(static_cast<std::int32_t>(id)));
  return all;
}

/// Of the image that is nearest now: with the pair within the cutoff it stays the nearest one.
PairPath KineticClosestPair::Impl::path(Edge edge) const {
  const Vec3 shift = images.to_nearest(edges->position(edge.b) - edges->position(edge.a));
  return {edges->plan(edge.a), edges->plan(edge.b), shift};
}

void KineticClosestPair::Impl::add(const PairTournament::Contender& contender) {
  const std::int32_t slot = tournament.add(contender, edges ? edges->now() : 0);
  slots(contender.edge.a).push_back(slot);
  slots(contender.edge.b).push_back(slot);
}

void KineticClosestPair::Impl::remove(Edge edge) {
  const auto slot = *std::find_if(slots(edge.a).begin(), slots(edge.a).end(),
                                  [&](std::int32_t k) { return tournament.of(k).edge == edge; });
  for (const std::int32_t id : {edge.a, edge.b}) {
    *std::find(slots(id).begin(), slots(id).end(), slot) = slots(id).back();
    slots(id).pop_back();
  }
  tournament.remove(slot, edges->now());
}

void KineticClosestPair::Impl::take(const EdgeEvent& event) {
  ++counters.edge_events;
  if (is_sparse) {
    load_edges();  // there is one now
  } else if (event.appears) {
    add({event.edge, path(event.edge)});
    if (tournament.size() <= most_edges) return;
    const double closest = std::sqrt(images.box().distance2(edges->position(tournament.closest().a),
                                                            edges->position(tournament.closest().b)));
    const double before = cutoff;
    const double wanted = std::max(sample_neighbor_distance(images.box(), plans(), edges->now()), closest);
    if (2 * wanted < before) return choose_cutoff(plans(), edges->now(), kRoom * closest);
    most_edges *= 2;
  } else {
    remove(event.edge);
    if (!tournament.empty()) return;
    if (cutoff < largest_cutoff) return choose_cutoff(plans(), edges->now(), 2 * cutoff);
    load_sparse();
  }
}

/// What happens at the time of a change is taken in before that is reported.
std::optional<ClosestChange> KineticClosestPair::Impl::next_until(double limit) {
  for (;;) {
    const double due = has_change() ? edges->now() : std::min({limit, tournament.next(), horizon});
    if (const auto event = edges->step(due)) {
      take(*event);
    } else if (tournament.next() <= due) {
      tournament.advance(due);
    } else if (horizon <= due) {
      load_sparse();
    } else if (has_change()) {
      ++counters.changes;
      return ClosestChange{due, std::exchange(reported, tournament.closest()), tournament.closest()};
    } else if (due == limit) {
      return std::nullopt;
    }
  }
}

void KineticClosestPair::Impl::follow(std::int32_t id) {
  if (is_sparse) return load_sparse();
  for (const std::int32_t slot : slots(id))
    tournament.change(slot, path(tournament.of(slot).edge), edges->now());
}

/// What follows ends with is_whole = true, unless it throws.
void KineticClosestPair::Impl::begin_change() {
  if (!is_whole)
    throw InvalidParameter("an earlier step or change of plan was broken off, at " +
                           detail::describe(edges->now()) + "; start anew from plans of then");
  is_whole = false;
}

KineticClosestPair::KineticClosestPair(const Box& box, Span<const FlightPlan> plans, double start)
    : impl_(std::make_unique<Impl>(box, plans, start)) {}
KineticClosestPair::~KineticClosestPair() = default;
KineticClosestPair::KineticClosestPair(KineticClosestPair&&) noexcept = default;
KineticClosestPair& KineticClosestPair::operator=(KineticClosestPair&&) noexcept = default;

std::size_t KineticClosestPair::size() const { return impl_->edges->size(); }
const Box& KineticClosestPair::box() const { return impl_->images.box(); }
double KineticClosestPair::now() const { return impl_->edges->now(); }
const FlightPlan& KineticClosestPair::plan(std::int32_t id) const { return impl_->edges->plan(id); }
Vec3 KineticClosestPair::position(std::int32_t id) const { return impl_->edges->position(id); }
Edge KineticClosestPair::pair() const { return impl_->reported; }
double KineticClosestPair::cutoff() const { return impl_->cutoff; }
double KineticClosestPair::next_event() const { return impl_->next_event(); }

double KineticClosestPair::distance() const {
  const Edge closest = pair();
  return closest.a < 0 ? kNever : std::sqrt(box().distance2(position(closest.a), position(closest.b)));
}

void KineticClosestPair::set_motion(std::int32_t id, Vec3 velocity, Vec3 acceleration) {
  Impl& all = *impl_;
  all.begin_change();
  try {
    all.edges->set_motion(id, velocity, acceleration);
  } catch (const InvalidParameter&) {
    all.is_whole = true;  // as it was, or the edges say so again
    throw;
  }
  all.follow(id);
  all.is_whole = true;
}

std::optional<ClosestChange> KineticClosestPair::step(double limit) {
  Impl& all = *impl_;
  check_time(limit, "time");
  if (limit < now())
    throw InvalidParameter("time = " + detail::describe(limit) + " is before now, " +
                           detail::describe(now()) +
                           "; time does not run back: start anew from plans of then");
  all.begin_change();
  const auto change = all.next_until(limit);
  all.is_whole = true;
  return change;
}

void KineticClosestPair::advance_to(double time, const ClosestCallback& callback) {
  while (const auto change = step(time))
    if (callback) callback(*change);
}

ClosestCounters KineticClosestPair::counters() const {
  ClosestCounters counters = impl_->counters;
  counters.lost = impl_->tournament.lost();
  counters.edges = static_cast<std::int64_t>(impl_->tournament.size());
  counters.certificates = impl_->tournament.certificates();
  counters.made = impl_->tournament.made();
  return counters;
}

std::int64_t KineticClosestPair::certificates_of(std::int32_t id) const {
  std::int64_t count = 0;
  for (const std::int32_t slot : impl_->slots(id)) count += impl_->tournament.certificates_of(slot);
  return count;
}

}  // namespace dch::kinetic

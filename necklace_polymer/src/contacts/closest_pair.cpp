// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <dch/engines/pair_search.hpp>
#include <dch/necklace/closest_pair.hpp>

#include "chains/bead_check.hpp"
#include "contacts/contact_of.hpp"

namespace dch::necklace {

namespace {

void check(const std::unique_ptr<ProximityDiagram>& diagram) {
  if (diagram == nullptr) {
    throw InvalidParameter("there is no diagram; hand one in, for example that of dch::power_diagram");
  }
}

}  // namespace

/// The best of the pairs that were offered.
class ClosestPair::Best {
 public:
  Best(const Necklace& necklace, const std::vector<Ball>& beads, int skip_bonds)
      : necklace_(necklace), beads_(beads), skip_(skip_bonds) {}

  bool neighbors(std::int32_t p, std::int32_t q) const {
    const std::int32_t bonds = necklace_.bonds_between(p, q);
    return bonds >= 0 && bonds <= skip_;
  }
  /// A pair of places; neighbors and a bead with itself do not count.
  void offer(std::int32_t p, std::int32_t q) {
    if (p == q || neighbors(p, q)) return;
    const Ball &a = beads_[static_cast<std::size_t>(p)], &b = beads_[static_cast<std::size_t>(q)];
    const double gap = std::sqrt(norm2(b.center - a.center)) - a.radius - b.radius;
    if (gap > gap_) return;
    std::int32_t i = particle(p), j = particle(q);
    if (i > j) std::swap(i, j);
    if (gap == gap_ && found_ && (i > i_ || (i == i_ && j >= j_))) return;
    gap_ = gap, i_ = i, j_ = j, found_ = true;
    first_ = particle(p) == i ? p : q;
    second_ = first_ == p ? q : p;
  }
  bool found() const { return found_; }
  double gap() const { return gap_; }
  Contact contact() const {
    const Ball& a = beads_[static_cast<std::size_t>(first_)];
    const Ball& b = beads_[static_cast<std::size_t>(second_)];
    return detail::contact_of(i_, j_, a.center, b.center - a.center, a.radius, b.radius);
  }

 private:
  std::int32_t particle(std::int32_t place) const {
    return necklace_.particle()[static_cast<std::size_t>(place)];
  }

  const Necklace& necklace_;
  const std::vector<Ball>& beads_;
  int skip_;
  bool found_ = false;
  double gap_ = std::numeric_limits<double>::infinity();
  std::int32_t i_ = -1, j_ = -1, first_ = -1, second_ = -1;
};

ClosestPair::ClosestPair(Necklace necklace, std::unique_ptr<ProximityDiagram> diagram)
    : necklace_(std::move(necklace)), diagram_(std::move(diagram)) {
  check(diagram_);
  for (const std::int32_t particle : necklace_.particle()) {
    equal_ = equal_ && necklace_.radius(particle) == necklace_.largest_radius();
  }
}

void ClosestPair::update(Span<const Vec3> positions, const Box& box) {
  ready_ = false;
  if (box.any_periodic()) {
    throw InvalidParameter("the box is periodic (" + box.description() + "), and a " + diagram_->name() +
                           " is of open space; take a WrappedHierarchy");
  }
  detail::check_positions(necklace_, positions);
  beads_.clear();
  for (const std::int32_t particle : necklace_.particle()) {
    beads_.push_back({positions[static_cast<std::size_t>(particle)], necklace_.radius(particle)});
  }
  diagram_->update(beads_);
  ready_ = true;
}

std::optional<Contact> ClosestPair::find(int skip_bonds, ClosestPairStats* stats) const {
  if (skip_bonds < 0) {
    throw InvalidParameter("skip_bonds is " + std::to_string(skip_bonds) + "; it has to be 0 or more");
  }
  if (!ready_) throw InvalidParameter("there are no positions; update before a search");
  ClosestPairStats counts;
  Best best(necklace_, beads_, skip_bonds);
  look_at_edges(best, counts);
  look_along_chains(best, skip_bonds, counts);
  if (!equal_) look_at_listed(best, counts);
  if (stats != nullptr) *stats = counts;
  if (!best.found()) return std::nullopt;
  return best.contact();
}

/// The balls at each place where there are several, by the one that stands for them, in order of particles.
ClosestPair::Places ClosestPair::shared_places() const {
  const std::vector<IndexPair> coincident = diagram_->coincident();
  Places places(coincident.empty() ? 0 : beads_.size());
  for (const auto& [bead, stands] : coincident) {
    auto& place = places[static_cast<std::size_t>(stands)];
    if (place.empty()) place.push_back(stands);
    place.push_back(bead);
  }
  const auto particle = necklace_.particle();
  for (auto& place : places) {
    std::sort(place.begin(), place.end(), [&](std::int32_t p, std::int32_t q) {
      return particle[static_cast<std::size_t>(p)] < particle[static_cast<std::size_t>(q)];
    });
  }
  return places;
}

/// Offers the pair of smallest (i, j) at one place that are no neighbors. A bead has few neighbors, so the
/// search is short, however many stand there.
void ClosestPair::look_at_place(Best& best, const std::vector<std::int32_t>& place) {
  for (std::size_t a = 0; a < place.size(); ++a) {
    for (std::size_t b = a + 1; b < place.size(); ++b) {
      if (best.neighbors(place[a], place[b])) continue;
      return best.offer(place[a], place[b]);
    }
  }
}

/// Edges join all that stand at their ends, unless the closest pair stands at one place.
void ClosestPair::look_at_edges(Best& best, ClosestPairStats& stats) const {
  const Places places = shared_places();
  for (const auto& place : places) look_at_place(best, place);
  const bool alone = places.empty() || best.found();
  for (const auto& [a, b] : diagram_->edges()) {
    ++stats.edges;
    best.offer(a, b);
    if (alone) continue;
    const auto& at_a = places[static_cast<std::size_t>(a)];
    const auto& at_b = places[static_cast<std::size_t>(b)];
    for (const std::int32_t p : at_a) best.offer(p, b);
    for (const std::int32_t q : at_b) best.offer(a, q);
    for (const std::int32_t p : at_a) {
      for (const std::int32_t q : at_b) best.offer(p, q);
    }
  }
}

/// Pairs with a common neighbor have at most twice as many bonds between them. For unequal radii, where balls
/// may be hidden from the diagram, the first bead is compared with all, so that there is a bound.
void ClosestPair::look_along_chains(Best& best, int skip_bonds, ClosestPairStats& stats) const {
  for (std::size_t chain = 0; chain < necklace_.chains().size(); ++chain) {
    const std::int32_t first = necklace_.first_place(chain);
    const std::int32_t beads = necklace_.first_place(chain + 1) - first;
    const auto max_bonds =
        static_cast<std::int32_t>(std::min<std::int64_t>(2 * std::int64_t{skip_bonds}, beads - 1));
    const bool closed = necklace_.chains().closed(chain);
    for (std::int32_t k = 0; k < beads; ++k) {
      for (std::int32_t bonds = skip_bonds + 1; bonds <= max_bonds; ++bonds) {
        if (k + bonds >= beads && !closed) break;
        ++stats.common;
        best.offer(first + k, first + (k + bonds) % beads);
      }
    }
  }
  if (equal_) return;
  for (std::int32_t p = 1; p < static_cast<std::int32_t>(beads_.size()); ++p) best.offer(0, p);
}

void ClosestPair::look_at_listed(Best& best, ClosestPairStats& stats) const {
  if (!best.found()) return;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Ball& bead : beads_) {
    centers.push_back(bead.center);
    radii.push_back(bead.radius);
  }
  ListParams params;
  params.radii = radii;
  // A little more, so that rounding does not lose the pair that the bound is of.
  params.skin = std::max(best.gap(), 0.0) * (1 + 1e-12) + 1e-12 * necklace_.largest_radius();
  params.order = RowOrder::unsorted;
  HierarchyParams structure;
  structure.radius = params.list_radius();
  structure.size_classes = true;
  const auto search = make_dch_search(structure);
  search->update(centers, Box::none());
  const NeighborList list = search->list(params);
  for (std::size_t row = 0; row < list.size(); ++row) {
    const auto p = list.particle.empty() ? static_cast<std::int32_t>(row) : list.particle[row];
    for (const std::int32_t q : list.row(row)) {
      ++stats.listed;
      best.offer(p, q);
    }
  }
}

}  // namespace dch::necklace

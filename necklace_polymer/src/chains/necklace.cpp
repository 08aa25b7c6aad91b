// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <dch/necklace/necklace.hpp>

#include "chains/bead_check.hpp"

namespace dch::necklace {

namespace {

constexpr double kPi = 3.14159265358979323846;

std::string number(double value) { return std::to_string(value); }

std::string bond_name(const IndexPair& bond) {
  return "bond " + std::to_string(bond[0]) + "-" + std::to_string(bond[1]);
}

/// Angle between the outward normals of two balls where their surfaces meet; pi if they do not overlap.
double normal_angle(double a, double b, double distance) {
  if (distance >= a + b) return kPi;
  if (distance <= std::abs(a - b)) return 0;
  return std::acos(std::clamp((a * a + b * b - distance * distance) / (2 * a * b), -1.0, 1.0));
}

/// Names the first coordinate that is not one.
[[noreturn]] void refuse(const Necklace& necklace, Span<const Vec3> positions) {
  for (const std::int32_t bead : necklace.particle()) {
    const Vec3 p = positions[static_cast<std::size_t>(bead)];
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(p[axis]) <= kMaxCoordinate) continue;
      throw InvalidPosition("bead " + std::to_string(bead) + " has the coordinate " + number(p[axis]) +
                            "; coordinates have to be finite and at most 1e100 in magnitude");
    }
  }
  throw InvalidPosition("positions changed while they were read");
}

/// Takes the bonds one by one.
class Measuring {
 public:
  void take(const IndexPair& bond, double distance, double a, double b) {
    const double gap = distance - a - b;
    const double angle = normal_angle(a, b, distance);
    if (!any_ || gap > measure_.largest_gap) measure_.largest_gap = gap, measure_.widest_gap = bond;
    if (!any_ || angle < measure_.beta) measure_.beta = angle, measure_.deepest_overlap = bond;
    measure_.shortest_bond = any_ ? std::min(measure_.shortest_bond, distance) : distance;
    measure_.longest_bond = std::max(measure_.longest_bond, distance);
    any_ = true;
  }
  NecklaceMeasure result() const {
    NecklaceMeasure result = measure_;
    if (!any_) result.beta = kPi;
    return result;
  }

 private:
  NecklaceMeasure measure_;
  bool any_ = false;
};

}  // namespace

Necklace::Necklace(Chains chains, std::vector<double> radii)
    : chains_(std::move(chains)), radii_(std::move(radii)) {
  if (radii_.size() != chains_.particles()) {
    throw InvalidParameter("there are " + std::to_string(radii_.size()) + " radii for chains over " +
                           std::to_string(chains_.particles()) + " particles; give one for each");
  }
  for (std::size_t k = 0; k < radii_.size(); ++k) {
    if (!(radii_[k] >= 0 && radii_[k] <= kMaxCoordinate)) {
      throw InvalidParameter("the radius of bead " + std::to_string(k) + " is " + number(radii_[k]) +
                             "; radii have to be finite, >= 0 and at most 1e100");
    }
  }
  for (std::size_t chain = 0; chain < chains_.size(); ++chain) {
    for (const std::int32_t bead : chains_.beads(chain)) {
      particle_.push_back(bead);
      largest_radius_ = std::max(largest_radius_, radius(bead));
    }
    first_place_.push_back(static_cast<std::int32_t>(particle_.size()));
  }
}

Necklace::Necklace(const Chains& chains, double radius)
    : Necklace(chains, std::vector<double>(chains.particles(), radius)) {}

Necklace Necklace::chain(std::vector<double> radii, bool closed) {
  std::vector<std::int32_t> order(radii.size());
  std::iota(order.begin(), order.end(), 0);
  Chains chains(radii.size());
  if (!order.empty()) chains.add(order, closed);
  return {std::move(chains), std::move(radii)};
}

std::int32_t Necklace::bonds_between(std::int32_t place, std::int32_t other) const {
  const std::size_t chain = chain_at(place);
  if (other < first_place_[chain] || other >= first_place_[chain + 1]) return -1;
  const std::int32_t along = std::abs(place - other);
  if (!chains_.closed(chain)) return along;
  return std::min(along, first_place_[chain + 1] - first_place_[chain] - along);
}

NecklaceMeasure Necklace::measure(Span<const Vec3> positions, const Box& box) const {
  detail::check_positions(*this, positions);
  Measuring measuring;
  for (const IndexPair& bond : chains_.bonds()) {
    const auto a = static_cast<std::size_t>(bond[0]), b = static_cast<std::size_t>(bond[1]);
    measuring.take(bond, std::sqrt(box.distance2(positions[a], positions[b])), radii_[a], radii_[b]);
  }
  NecklaceMeasure result = measuring.result();
  double smallest = largest_radius_;
  for (const std::int32_t bead : particle_) smallest = std::min(smallest, radius(bead));
  if (largest_radius_ > 0) {
    result.alpha = smallest > 0 ? largest_radius_ / smallest : std::numeric_limits<double>::infinity();
  }
  return result;
}

void require(const NecklaceMeasure& measure, const NecklaceLimits& limits) {
  if (measure.alpha > limits.max_alpha) {
    throw NotANecklace("the largest radius is " + number(measure.alpha) +
                       " times the smallest, the limit is " + number(limits.max_alpha) +
                       "; allow more or give the beads more even radii");
  }
  if (measure.beta < limits.min_beta) {
    throw NotANecklace(bond_name(measure.deepest_overlap) + " lets beads overlap to an angle of " +
                       number(measure.beta) + " rad between their normals, the limit is " +
                       number(limits.min_beta) + "; allow less or take smaller radii");
  }
  if (measure.largest_gap > limits.max_gap) {
    throw NotANecklace(bond_name(measure.widest_gap) + " leaves a gap of " + number(measure.largest_gap) +
                       " between its beads, the limit is " + number(limits.max_gap) +
                       "; allow more or take larger radii");
  }
  if (measure.longest_bond > limits.max_bond_ratio * measure.shortest_bond) {
    throw NotANecklace("bonds are from " + number(measure.shortest_bond) + " to " +
                       number(measure.longest_bond) + " long, the limit of the ratio is " +
                       number(limits.max_bond_ratio) + "; allow more or check the bonds");
  }
}

namespace detail {

double check_positions(const Necklace& necklace, Span<const Vec3> positions) {
  if (positions.size() != necklace.particles()) {
    throw InvalidParameter("there are " + std::to_string(positions.size()) + " positions for a necklace of " +
                           std::to_string(necklace.particles()) + " particles; give one for each");
  }
  bool well = true;
  double largest = 0;
  for (const std::int32_t bead : necklace.particle()) {
    const Vec3& p = positions[static_cast<std::size_t>(bead)];
    const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
    well &= (x <= kMaxCoordinate) & (y <= kMaxCoordinate) & (z <= kMaxCoordinate);
    largest = std::max(largest, std::max(std::max(x, y), z));
  }
  if (!well) refuse(necklace, positions);
  return largest;
}

}  // namespace detail

}  // namespace dch::necklace

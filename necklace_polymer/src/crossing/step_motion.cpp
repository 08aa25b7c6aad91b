// SPDX-License-Identifier: MIT
#include "crossing/step_motion.hpp"

#include <algorithm>
#include <cmath>

#include "crossing/pair_motion.hpp"
#include "geometry/dual_basis.hpp"

namespace dch::necklace::detail {
namespace {

std::array<Vec3, 3> periodic_cell(const Box& box) {
  std::array<Vec3, 3> cell{};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.periodic(axis)) cell[static_cast<std::size_t>(axis)] = box.vector(axis);
  }
  return cell;
}

Image image_of(Vec3 integers) {
  const auto whole = [](double x) { return static_cast<std::int32_t>(std::clamp(x, -2e9, 2e9)); };
  return {whole(integers.x), whole(integers.y), whole(integers.z)};
}

Image plus(const Image& a, const Image& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

bool is_home(const Image& image) { return image == Image{}; }

double magnitude_of(const Image& image, const std::array<Vec3, 3>& cell) {
  double result = 0;
  for (std::size_t k = 0; k < 3; ++k) result += std::abs(image[k]) * largest(cell[k]);
  return result;
}

}  // namespace

StepMotion::StepMotion(Span<const Vec3> from, const Box& from_box, Span<const Vec3> to, const Box& to_box)
    : from_(from),
      to_(to),
      from_box_(from_box),
      to_box_(to_box),
      middle_box_(from_box),
      same_box_(from_box == to_box),
      cell_from_(periodic_cell(from_box)),
      cell_to_(periodic_cell(to_box)),
      lattice_from_(from_box),
      lattice_to_(to_box),
      lattice_middle_(from_box),
      limit2_(std::pow(std::min(from_box.max_cutoff(), to_box.max_cutoff()), 2)) {
  if (same_box_) return;
  std::array<Vec3, 3> periods{}, middle{};
  std::array<std::size_t, 3> axes{};
  int rank = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const Vec3 old = from_box.vector(axis);
    middle[k] = 0.5 * (old + to_box.vector(axis));
    if (!from_box.periodic(axis)) continue;
    const Vec3 change = to_box.nearest_image(cell_to_[k] - old);
    Image image = image_of(lattice_to_.integers(change - (cell_to_[k] - old)));
    ++image[k];
    carry_[k] = image;
    change_[k] = sum(image, cell_to_) - old;
    middle[k] = old + 0.5 * change_[k];
    axes[static_cast<std::size_t>(rank)] = k;
    periods[static_cast<std::size_t>(rank++)] = old;
  }
  const auto dual = dch::detail::dual_basis(periods, rank);
  for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) dual_from_[axes[k]] = dual[k];
  const Box::Periodic periodic{from_box.periodic(0), from_box.periodic(1), from_box.periodic(2)};
  if (from_box.kind() != Box::Kind::none)
    middle_box_ = Box::triclinic(middle[0], middle[1], middle[2], periodic, from_box.origin());
  lattice_middle_ = dch::detail::Lattice(middle_box_);
}

Vec3 StepMotion::sum(const Image& image, const std::array<Vec3, 3>& cell) {
  return static_cast<double>(image[0]) * cell[0] + static_cast<double>(image[1]) * cell[1] +
         static_cast<double>(image[2]) * cell[2];
}

Image StepMotion::carried(const Image& image) const {
  Image result{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t n = 0; n < 3; ++n) result[n] += image[k] * carry_[k][n];
  }
  return result;
}

Vec3 StepMotion::carried_along(Vec3 position) const {
  const Vec3 inside = position - from_box_.origin(), moved = to_box_.origin() - from_box_.origin();
  Vec3 result = position;
  for (std::size_t k = 0; k < 3; ++k) {
    result = result + dot(dual_from_[k], inside) * change_[k] + dot(dual_from_[k], moved) * cell_from_[k];
  }
  return result;
}

StepMotion::BeadStep StepMotion::bead(std::int32_t index) const {
  const Vec3 given = to_[static_cast<std::size_t>(index)];
  const Vec3 expected = same_box_ ? from_[static_cast<std::size_t>(index)]
                                  : carried_along(from_[static_cast<std::size_t>(index)]);
  const Vec3 step = given - expected;
  const Vec3 shortest = to_box_.nearest_image(step);
  BeadStep result{given, {}, largest(given), norm2(shortest) < limit2_};
  if (shortest == step) return result;
  result.image = image_of(lattice_to_.integers(shortest - step));
  result.to = given + sum(result.image, cell_to_);
  result.magnitude += magnitude_of(result.image, cell_to_);
  return result;
}

BondStep StepMotion::bond(IndexPair beads) const {
  const Vec3 a = from_[static_cast<std::size_t>(beads[0])], b = from_[static_cast<std::size_t>(beads[1])];
  const BeadStep step_a = bead(beads[0]), step_b = bead(beads[1]);
  const Vec3 along = b - a, shortest = from_box_.nearest_image(along);
  BondStep result{{a, b, step_a.to, step_b.to},
                  std::max({largest(a), largest(b), step_a.magnitude, step_b.magnitude}),
                  {},
                  step_a.image,
                  step_b.image,
                  step_a.determined && step_b.determined,
                  norm2(shortest) < limit2_};
  if (shortest != along) {
    result.from_b = image_of(lattice_from_.integers(shortest - along));
    result.to_b = plus(step_b.image, carried(result.from_b));
    result.ends.from_b = b + sum(result.from_b, cell_from_);
    result.ends.to_b = to_[static_cast<std::size_t>(beads[1])] + sum(result.to_b, cell_to_);
    result.magnitude = std::max(result.magnitude, largest(b) + magnitude_of(result.from_b, cell_from_));
    result.magnitude = std::max(result.magnitude, largest(to_[static_cast<std::size_t>(beads[1])]) +
                                                      magnitude_of(result.to_b, cell_to_));
  }
  result.bond_determined &= norm2(result.ends.to_b - result.ends.to_a) < limit2_;
  return result;
}

double StepMotion::shift_magnitude(const Image& image) const {
  if (is_home(image)) return 0;
  return std::max(magnitude_of(image, cell_from_), magnitude_of(carried(image), cell_to_));
}

PairEnds StepMotion::ends(IndexPair p, IndexPair q, const BondStep& step_p, const BondStep& step_q,
                          const Image& image) const {
  const auto from = [&](std::int32_t bead) { return from_[static_cast<std::size_t>(bead)]; };
  const auto to = [&](std::int32_t bead) { return to_[static_cast<std::size_t>(bead)]; };

  const Image later = carried(image);
  PairEnds result;
  result.from = {{{from(p[0]), {}},
                  {from(p[1]), step_p.from_b},
                  {from(q[0]), image},
                  {from(q[1]), plus(step_q.from_b, image)}}};
  result.to = {{{to(p[0]), step_p.to_a},
                {to(p[1]), step_p.to_b},
                {to(q[0]), plus(step_q.to_a, later)},
                {to(q[1]), plus(step_q.to_b, later)}}};
  result.cell_from = cell_from_;
  result.cell_to = cell_to_;
  const auto number = [](std::int32_t bead) { return static_cast<std::uint64_t>(bead); };
  result.beads = {number(p[0]), number(p[1]), number(q[0]), number(q[1])};
  return result;
}

Image StepMotion::middle_image(Vec3 shift) const { return image_of(lattice_middle_.integers(shift)); }

}  // namespace dch::necklace::detail

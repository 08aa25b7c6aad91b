// SPDX-License-Identifier: MIT
#include "box_change.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <dch/kinetic/contacts_between.hpp>

#include "base/describe.hpp"

namespace dch::kinetic {
namespace {

using Periods = std::array<Vec3, 3>;

/// Length, area or volume of a cell.
double measure(const Periods& periods, int rank) {
  if (rank == 0) return 1;
  if (rank == 1) return std::sqrt(norm2(periods[0]));
  const Vec3 normal = cross(periods[0], periods[1]);
  return rank == 2 ? std::sqrt(norm2(normal)) : std::abs(dot(normal, periods[2]));
}

/// A vector of the same length that is normal to another.
Vec3 normal_to(Vec3 v) {
  const bool leans_to_x = std::abs(v.x) > std::abs(v.y);
  const Vec3 normal = cross(v, leans_to_x ? Vec3{0, 1, 0} : Vec3{1, 0, 0});
  return std::sqrt(norm2(v) / norm2(normal)) * normal;
}

/// A box with these periods, and open in all other directions.
Box box_of(Periods periods, int rank, Vec3 origin) {
  if (rank == 0) return Box::none();
  if (rank == 1) periods[1] = normal_to(periods[0]);
  if (rank < 3) {
    const Vec3 normal = cross(periods[0], periods[1]);
    periods[2] = std::sqrt(norm2(periods[0]) / norm2(normal)) * normal;
  }
  return Box::triclinic(periods[0], periods[1], periods[2], {true, rank > 1, rank > 2}, origin);
}

}  // namespace

BoxChange::BoxChange(const Box& before, const Box& after)
    : after_(after), middle_(before), origin_(before.origin()) {
  if (!same_periodicity(before, after)) {
    fault_ = "the box is " + before.description() + " and then " + after.description();
  } else if (before.reduced() != after.reduced()) {
    follow(before);
  }
}

void BoxChange::follow(const Box& before) {
  const int rank = before.rank();
  Periods then = before.reduced(), halfway = then;
  for (int k = 0; k < rank; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Vec3 gain = -1.0 * after_.nearest_image(then[at]);
    halfway[at] = then[at] + 0.5 * gain;
    growth_.add_outer(gain, before.reduced_dual()[at]);
    then[at] = then[at] + gain;
  }
  strain_ = growth_.norm();
  if (!(strain_ <= kMaxStrain)) {
    fault_ = "the box changes by " + detail::describe(strain_) + " of itself, and by more than " +
             detail::describe(kMaxStrain) + " images cannot be followed";
    return;
  }
  // The vectors that near periods go to make up the later cell, unless there are others between them.
  if (std::abs(measure(then, rank) / measure(after_.reduced(), rank) - 1) > 1e-3) {
    fault_ = "the box repeats more often than before, so that images cannot be followed";
    return;
  }
  is_none_ = false;
  turn_ = growth_ * identity_plus(0.5, growth_).inverse();
  for (int k = 0; k < rank; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double part = dot(after_.reduced_dual()[at], after_.origin() - before.origin());
    shift_ = shift_ + part * after_.reduced()[at];
  }
  middle_ = box_of(halfway, rank, before.origin() + 0.5 * shift_);
}

Vec3 BoxChange::along_periods(Vec3 displacement) const {
  if (middle_.rank() == 3) return displacement;
  Vec3 along;
  for (int k = 0; k < middle_.rank(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    along = along + dot(middle_.reduced_dual()[at], displacement) * middle_.reduced()[at];
  }
  return along;
}

bool BoxChange::is_ambiguous(Vec3 displacement) const {
  const double half = middle_.max_cutoff();
  return norm2(along_periods(displacement)) >= half * half;
}

}  // namespace dch::kinetic

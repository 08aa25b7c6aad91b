// SPDX-License-Identifier: GPL-2.0-or-later
#include "moving_bonds.h"

#include <algorithm>
#include <cmath>
#include <domain.h>
#include <utility>

namespace LAMMPS_NS {
namespace {

/// Of the box between two checks; no bond can be followed beyond.
constexpr double kMostStrain = 0.5;

/// Ghosts are looked at with a little more than what their owners allow, so that rounding leaves out none
/// that an owner has let pass.
constexpr double kMoreForGhosts = 1 + 1e-9;

std::array<float, 3> rounded(dch::Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

void MovingBonds::gather(const MovingAtoms& atoms, const dch::lammps::BoxStep& step, const Limits& limits) {
  atoms_ = &atoms;
  step_ = step;
  limits_ = limits;
  // Middles that are c apart come nearer by a share of c that the box takes: the reach is that much larger.
  const double strain = step.strain();
  stretch_ = strain < kMostStrain ? 1 / (1 - strain) : HUGE_VAL;
  clear(atoms.bonds_held());
  undetermined_ = 0;
  radius_ = largest_extent_ = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    atoms.for_bonds_of_owned(i, [&](tagint partner, bool was_there) {
      int j = atom->map(partner);
      if (j >= 0 && !limits.in_box) j = domain->closest_image(i, j);
      if (j >= 0 && !atoms.in_group(j)) return;
      if (!was_there) return;
      if (j < 0) {
        ++undetermined_;  // the atom has been lost, or is no ghost here
      } else {
        add(i, j, true);
      }
    });
  }
  owned_ = ends_.size();
  if (limits.in_box) return;
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; ++i) {
    atoms.for_bonds_of_ghost(i, [&](tagint partner, bool was_there) {
      int j = atom->map(partner);
      if (j >= 0) j = domain->closest_image(i, j);
      if (j >= 0 && was_there && atoms.in_group(j)) add(i, j, false);
    });
  }
}

/// With room for the bonds that are to come: arrays that grew would have half of theirs in vain.
void MovingBonds::clear(std::size_t expected) {
  ends_.clear();
  middles_.clear();
  radii_.clear();
  ends_.reserve(expected);
  middles_.reserve(expected);
  radii_.reserve(expected);
}

std::array<dch::Vec3, 2> MovingBonds::moves(const dch::necklace::MovingBond& path, dch::Vec3 middle) const {
  const dch::Vec3 drift = step_.is_still() ? dch::Vec3{} : step_.drift_of_point(middle);
  return {path.to_a - path.from_a - drift, path.to_b - path.from_b - drift};
}

MovingBonds::Shape MovingBonds::shape(std::size_t bond) const {
  const dch::necklace::MovingBond path = path_of(ends_[bond][0], ends_[bond][1]);
  const dch::Vec3 before = path.from_b - path.from_a, now = path.to_b - path.to_a;
  const auto [first, second] = moves(path, middles_[bond]);
  return {rounded(0.25 * (before + now)), rounded(0.25 * (first + second)), rounded(0.25 * (now - before))};
}

void MovingBonds::add(int i, int j, bool is_owned) {
  if (atom->tag[i] > atom->tag[j]) std::swap(i, j);
  const dch::necklace::MovingBond path = path_of(i, j);
  const dch::Vec3 before = path.from_b - path.from_a, now = path.to_b - path.to_a;
  const dch::Vec3 middle = 0.25 * ((path.from_a + path.from_b) + (path.to_a + path.to_b));
  const auto [first, second] = moves(path, middle);
  const double length = std::sqrt(std::max(norm2(before), norm2(now)));
  const double extent = stretch_ * (length + std::sqrt(std::max(norm2(first), norm2(second))));
  const double more = is_owned ? 1.0 : kMoreForGhosts;
  if (!(length < limits_.length * more && extent <= limits_.extent * more)) {
    if (!is_owned) return;
    ++undetermined_;
    if (extent > largest_extent_) largest_extent_ = extent;
    return;
  }
  if (is_owned) largest_extent_ = std::max(largest_extent_, extent);
  ends_.push_back({i, j});
  middles_.push_back(middle);
  const double radius = stretch_ * (0.5 * length + 0.25 * std::sqrt(norm2(first + second)));
  radii_.push_back(static_cast<float>(radius));
  radius_ = std::max(radius_, radius);
}

dch::necklace::MovingBond MovingBonds::path_of(int i, int j) const {
  dch::necklace::MovingBond path{atoms_->before(i), atoms_->before(j), atoms_->now(i), atoms_->now(j)};
  if (!limits_.in_box) return path;
  if (norm2(path.to_b - path.to_a) < limits_.length * limits_.length) return path;
  const dch::Vec3 n = step_.now().nearest(path.to_b - path.to_a);
  path.from_b = path.from_b - step_.before().vector(n);
  path.to_b = path.to_b - step_.now().vector(n);
  return path;
}

dch::necklace::MovingBond MovingBonds::path(std::size_t bond, dch::Vec3 shift) const {
  dch::necklace::MovingBond path = path_of(ends_[bond][0], ends_[bond][1]);
  const dch::Vec3 before = step_.before().vector(shift), now = step_.now().vector(shift);
  path.from_a = path.from_a + before;
  path.from_b = path.from_b + before;
  path.to_a = path.to_a + now;
  path.to_b = path.to_b + now;
  return path;
}

std::array<tagint, 2> MovingBonds::tags(std::size_t bond) const {
  return {atom->tag[ends_[bond][0]], atom->tag[ends_[bond][1]]};
}

double MovingBonds::memory_bytes() const {
  return static_cast<double>(ends_.capacity() * sizeof(ends_[0]) + middles_.capacity() * sizeof(dch::Vec3) +
                             radii_.capacity() * sizeof(float));
}

}  // namespace LAMMPS_NS

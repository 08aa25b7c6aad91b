// SPDX-License-Identifier: GPL-2.0-or-later
#include "crossing_finder.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace {

/// The search is made for so much more than the reach, and made anew when that is too little or half of it
/// would do.
constexpr double kSpare = 1.1;

/// Of the reach: more than single precision can be off in the products below.
constexpr double kSlack = 1e-5;

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

float sum_of_sizes(const std::array<float, 3>& a) {
  return std::fabs(a[0]) + std::fabs(a[1]) + std::fabs(a[2]);
}

}  // namespace

void CrossingFinder::find(const MovingBonds& bonds, const dch::Box& box, const dch::lammps::Cell& cell,
                          double thickness) {
  bonds_ = &bonds;
  box_ = &box;
  cell_ = &cell;
  thickness_ = thickness;
  crossings_.clear();
  counts_ = {};
  if (bonds.size() < 2) return;
  const double reach = std::max(2 * bonds.radius() + thickness * bonds.stretch(), dch::kMinListRadius);
  slack_ = static_cast<float>(kSlack * reach);
  if (!search_ || reach > radius_ || reach < 0.5 * radius_) {
    radius_ = std::min(kSpare * reach, std::max(reach, box.max_cutoff() * (1 - 1e-9)));
    search_ = dch::make_auto_search(dch::HierarchyParams{radius_});
  }
  search_->update_by_reference(bonds.middles(), box);
  dch::ListParams params;
  params.cutoffs = dch::TypeCutoffs(reach);
  params.superset = true;
  params.first_ghost = static_cast<std::int32_t>(bonds.owned());
  search_->list_in_pieces(params, [&](const dch::NeighborList& piece) { take(piece); });
}

void CrossingFinder::take(const dch::NeighborList& piece) {
  const auto middles = bonds_->middles();
  for (std::size_t row = 0; row < piece.size(); ++row) {
    const auto i = static_cast<std::size_t>(piece.particle.empty() ? static_cast<std::int32_t>(row)
                                                                   : piece.particle[row]);
    for (const std::int32_t other : piece.row(row)) {
      const auto j = static_cast<std::size_t>(other);
      const dch::Vec3 between = box_->nearest_image(middles[j] - middles[i]);
      if (!balls_meet(i, j, between) || bonds_->share_an_end(i, j) || !is_mine(i, j)) continue;
      ++counts_.near;
      if (kept_apart(i, j, between)) {
        ++counts_.rejected;
      } else {
        test(i, j, between);
      }
    }
  }
}

/// The process that holds the first bond, by IDs, tests the pair.
bool CrossingFinder::is_mine(std::size_t i, std::size_t j) const {
  if (std::max(i, j) < bonds_->owned()) return true;
  const bool i_is_first = bonds_->tags(i) < bonds_->tags(j);
  return (i_is_first ? i : j) < bonds_->owned();
}

bool CrossingFinder::balls_meet(std::size_t i, std::size_t j, dch::Vec3 between) const {
  const double reach =
      bonds_->radius(i) + bonds_->radius(j) + thickness_ * bonds_->stretch() + static_cast<double>(slack_);
  return norm2(between) <= reach * reach;
}

/// By the line between the middles, or the normal of the bonds.
bool CrossingFinder::kept_apart(std::size_t i, std::size_t j, dch::Vec3 between) const {
  const MovingBonds::Shape a = bonds_->shape(i), b = bonds_->shape(j);
  const std::array<float, 3> c{static_cast<float>(between.x), static_cast<float>(between.y),
                               static_cast<float>(between.z)};
  std::array<float, 3> move{b.half_move[0] - a.half_move[0], b.half_move[1] - a.half_move[1],
                            b.half_move[2] - a.half_move[2]};
  if (!bonds_->step().is_still()) {
    const dch::Vec3 drift = 0.5 * bonds_->step().drift(between);
    for (int k = 0; k < 3; ++k) move[static_cast<std::size_t>(k)] += static_cast<float>(drift[k]);
  }
  const auto thickness = static_cast<float>(thickness_);
  const auto separates = [&](const std::array<float, 3>& axis) {
    const float half = std::fabs(dot(a.half_bond, axis)) + std::fabs(dot(b.half_bond, axis)) +
                       std::fabs(dot(a.quarter_turn, axis)) + std::fabs(dot(b.quarter_turn, axis)) +
                       std::fabs(dot(move, axis));
    return std::fabs(dot(c, axis)) > half + (slack_ + thickness) * sum_of_sizes(axis);
  };
  if (separates(c)) return true;
  return separates({a.half_bond[1] * b.half_bond[2] - a.half_bond[2] * b.half_bond[1],
                    a.half_bond[2] * b.half_bond[0] - a.half_bond[0] * b.half_bond[2],
                    a.half_bond[0] * b.half_bond[1] - a.half_bond[1] * b.half_bond[0]});
}

void CrossingFinder::test(std::size_t i, std::size_t j, dch::Vec3 between) {
  auto first = bonds_->tags(i), second = bonds_->tags(j);
  if (first[0] == second[0] || first[0] == second[1] || first[1] == second[0] || first[1] == second[1]) {
    --counts_.near;  // with a common atom
    return;
  }
  if (second < first) {
    std::swap(first, second);
    std::swap(i, j);
    between = -1 * between;
  }
  dch::Vec3 shift;
  if (box_->any_periodic()) {
    shift = -1 * cell_->nearest(bonds_->middles()[j] - bonds_->middles()[i] - between);
  }
  const auto id = [](tagint tag) { return static_cast<std::uint64_t>(tag); };
  const auto encounter =
      dch::necklace::bond_encounter(bonds_->path(i), bonds_->path(j, shift), thickness_,
                                    {id(first[0]), id(first[1]), id(second[0]), id(second[1])});
  for (int k = 0; k < encounter.count; ++k) {
    const auto& crossing = encounter.crossings[static_cast<std::size_t>(k)];
    crossings_.push_back(
        {{first[0], first[1], second[0], second[1]}, crossing.time, crossing.place, crossing.sign});
  }
  if (encounter.contact) ++counts_.contacts;
  if (encounter.decided_by == dch::necklace::EncounterStage::zonotope) ++counts_.rejected;
}

double CrossingFinder::memory_bytes() const {
  return search_ ? static_cast<double>(search_->stats().memory_bytes) : 0;
}

}  // namespace LAMMPS_NS

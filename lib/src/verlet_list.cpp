// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>

#include <dch/error.hpp>
#include <dch/verlet_list.hpp>

#include "dual_basis.hpp"
#include "position_check.hpp"

namespace dch {
VerletList::VerletList(std::unique_ptr<PairSearch> search, ListParams params)
    : search_(std::move(search)), params_(std::move(params)) {
  if (!search_)
    throw InvalidParameter("no search engine given; make one with make_dch_search or make_cell_search");
  detail::check_skin(params_.skin);
}

bool VerletList::is_stale(Span<const Vec3> positions, const Box& box) const {
  if (!valid_ || positions.size() != reference_.size() || !same_periodicity(box, reference_box_)) return true;
  const double allowed = 0.5 * (params_.skin - strain(box));
  if (!(allowed >= 0)) return true;
  return !std::equal(positions.begin(), positions.end(), reference_.begin(), [&](Vec3 now, Vec3 then) {
    return norm2(box.nearest_image(now - then)) <= allowed * allowed;
  });
}

bool VerletList::update(Span<const Vec3> positions, const Box& box) {
  if (!is_stale(positions, box)) return false;
  valid_ = false;
  search_->update(positions, box);
  search_->list(params_, list_);
  remember(positions, box);
  valid_ = true;
  ++rebuilds_;
  return true;
}

void VerletList::remember(Span<const Vec3> positions, const Box& box) {
  reference_.assign(positions.begin(), positions.end());
  for (Vec3& p : reference_) p = box.wrap(p);
  reference_box_ = box;

  std::array<Vec3, 3> given{};
  std::array<std::size_t, 3> axes{};
  std::size_t rank = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box.periodic(axis)) continue;
    given[rank] = box.vector(axis);
    axes[rank++] = static_cast<std::size_t>(axis);
  }
  const auto dual = detail::dual_basis(given, box.rank());
  combinations_ = {};
  for (std::size_t k = 0; k < rank; ++k) {
    for (std::size_t l = 0; l < rank; ++l) {
      combinations_[k][axes[l]] = std::nearbyint(dot(dual[l], box.reduced()[k]));
    }
  }
}

std::array<Vec3, 3> VerletList::periods(const Box& box) const {
  std::array<Vec3, 3> periods;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      periods[k] = periods[k] + combinations_[k][static_cast<std::size_t>(axis)] * box.vector(axis);
    }
  }
  return periods;
}

/// The largest |(H - H0) n|, n in {-1, 0, 1}^3.
double VerletList::strain(const Box& box) const {
  const auto before = periods(reference_box_), now = periods(box);
  const Vec3 a = now[0] - before[0], b = now[1] - before[1], c = now[2] - before[2];
  double largest = 0;  // at a corner of the cube of n, and the same at the opposite one
  for (const Vec3 v : {a + b + c, a + b - c, a - b + c, a - b - c}) largest = std::max(largest, norm2(v));
  return std::sqrt(largest);
}

}  // namespace dch

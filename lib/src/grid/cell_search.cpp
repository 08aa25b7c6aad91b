// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "base/describe.hpp"
#include "base/key_table.hpp"
#include "base/seconds_since.hpp"
#include "geometry/metric.hpp"
#include "geometry/position_check.hpp"
#include "grid/cell_grid.hpp"
#include "hierarchy/candidate_buffer.hpp"
#include "lists/list_assembly.hpp"
#include "lists/list_check.hpp"
#include "lists/pair_filter.hpp"

namespace dch {
namespace {

using detail::seconds_since;

using detail::CellCoordinates;
using detail::CellNumbering;

class CellSearch final : public PairSearch {
 public:
  CellSearch(double radius, int divisions) : radius_(radius), divisions_(divisions) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void list(const ListParams& params, NeighborList& out) override;
  using PairSearch::list;
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return "cell"; }

 private:
  void clear();
  void take(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys);
  void find_pairs_by_shifts(const detail::PairFilter& filter);
  void find_pairs_by_nearest_images(const detail::PairFilter& filter);
  void gather(std::int32_t cell, Vec3 shift);
  template <class Metric>
  void test_gathered(const Metric& metric, std::size_t own_count, const detail::PairFilter& filter);
  std::size_t memory_bytes() const;

  double radius_;
  int divisions_;
  std::vector<Vec3> positions_;  ///< as given
  Box box_;
  double wrap_error_ = 0;
  detail::CellGrid grid_;
  SearchStats stats_;

  detail::KeyTable key_table_;
  std::vector<Vec3> wrapped_;
  detail::CandidateBuffer candidates_;  ///< points of a cell, then those of its neighbors
  detail::PairBuffer pairs_;
  detail::ListAssembler assembler_;
};

void CellSearch::clear() {
  positions_.clear();
  grid_.clear();
}

void CellSearch::update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  const auto start = std::chrono::steady_clock::now();
  clear();
  try {
    take(positions, box, keys);
  } catch (...) {
    clear();
    throw;
  }
  ++stats_.updates;
  ++stats_.builds;
  stats_.maintain_seconds += seconds_since(start);
  stats_.memory_bytes = memory_bytes();
}

void CellSearch::take(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
  if (!keys.empty()) key_table_.fill(positions.size(), keys);  // throws if they repeat
  detail::check_radius(radius_, box);
  const double reach = detail::check_positions(positions, box);

  const detail::WrapError error(box);
  wrap_error_ = error.bound(reach);
  wrapped_.assign(positions.begin(), positions.end());
  for (Vec3& p : wrapped_) p = box.wrap(p);
  grid_.build(wrapped_, box, (radius_ + wrap_error_) / divisions_);
  positions_.assign(positions.begin(), positions.end());
  box_ = box;
}

void CellSearch::list(const ListParams& params, NeighborList& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(params, positions_.size(), radius_);
  detail::make_or_empty({&out}, [&] {
    const detail::PairFilter filter(positions_, box_, params, wrap_error_ + params.cutoff_error());
    pairs_.clear();
    if (grid_.separates_images(divisions_)) {
      find_pairs_by_shifts(filter);
    } else {
      find_pairs_by_nearest_images(filter);
    }
    assembler_.assemble(positions_.size(), params.kind, params.first_ghost, pairs_, out);
  });
  stats_.list_seconds += seconds_since(start);
  stats_.memory_bytes = memory_bytes();
}

void CellSearch::gather(std::int32_t cell, Vec3 shift) {
  for (auto place = grid_.first_place(cell); place < grid_.first_place(cell + 1); ++place) {
    candidates_.append_if(true, grid_.position(place) + shift, grid_.point(place));
  }
}

/// Half of the offsets: of each pair of opposite ones the lexicographically positive one.
std::vector<CellCoordinates> half_stencil(int reach) {
  std::vector<CellCoordinates> offsets;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (z > 0 || (z == 0 && (y > 0 || (y == 0 && x > 0)))) offsets.push_back({x, y, z});
      }
    }
  }
  return offsets;
}

void CellSearch::find_pairs_by_shifts(const detail::PairFilter& filter) {
  const auto offsets = half_stencil(divisions_);
  const detail::OpenMetric metric{Box::none()};
  for (std::int32_t cell = 0; cell < grid_.cells(); ++cell) {
    candidates_.clear();
    gather(cell, {});
    const std::size_t own_count = candidates_.size();
    if (own_count == 0) continue;
    for (const CellCoordinates& offset : offsets) {
      Vec3 shift;
      const std::int32_t other = grid_.neighbor(cell, offset, shift);
      if (other != CellNumbering::kNone) gather(other, shift);
    }
    test_gathered(metric, own_count, filter);
  }
}

/// For boxes so narrow that a cell meets another one, or itself, on both sides: every pair of cells once, and
/// nearest images for each pair of points.
void CellSearch::find_pairs_by_nearest_images(const detail::PairFilter& filter) {
  const auto offsets = half_stencil(divisions_);
  std::vector<std::int32_t> others;
  detail::with_metric(box_, [&](const auto& metric) {
    for (std::int32_t cell = 0; cell < grid_.cells(); ++cell) {
      candidates_.clear();
      gather(cell, {});
      const std::size_t own_count = candidates_.size();
      if (own_count == 0) continue;
      others.clear();
      for (const CellCoordinates& o : offsets) {
        for (const int sign : {1, -1}) {
          Vec3 shift;
          const std::int32_t other = grid_.neighbor(cell, {sign * o[0], sign * o[1], sign * o[2]}, shift);
          if (other > cell) others.push_back(other);
        }
      }
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      for (const std::int32_t other : others) gather(other, {});
      test_gathered(metric, own_count, filter);
    }
  });
}

/// The first `own_count` candidates with each other and with all that follow.
template <class Metric>
void CellSearch::test_gathered(const Metric& metric, std::size_t own_count,
                               const detail::PairFilter& filter) {
  for (std::size_t a = 0; a < own_count; ++a) {
    const std::int32_t i = candidates_.node(a);
    const std::size_t hits =
        candidates_.select(metric, candidates_.position(a), a + 1, filter.largest_distance2());
    for (std::size_t h = 0; h < hits; ++h) {
      const std::size_t b = candidates_.hit(h);
      if (filter.accept(i, candidates_.node(b), candidates_.distance2(b))) pairs_.add(i, candidates_.node(b));
    }
  }
}

std::size_t CellSearch::memory_bytes() const {
  return (positions_.capacity() + wrapped_.capacity()) * sizeof(Vec3) + grid_.memory_bytes() +
         pairs_.memory_bytes() + assembler_.memory_bytes();
}

}  // namespace

std::unique_ptr<PairSearch> make_cell_search(double radius, int divisions) {
  constexpr double kLeast = 1e-100;  // squares of shorter ones would underflow
  if (!(std::isfinite(radius) && radius >= kLeast)) {
    throw InvalidParameter("the search radius is " + detail::describe(radius) +
                           "; it must be finite and at least " + detail::describe(kLeast));
  }
  if (divisions < 1 || divisions > 4) {
    throw InvalidParameter("cells of 1/" + std::to_string(divisions) +
                           " of the radius are not supported; divisions must be 1 to 4");
  }
  return std::make_unique<CellSearch>(radius, divisions);
}

}  // namespace dch

// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "base/describe.hpp"
#include "base/key_table.hpp"
#include "base/seconds_since.hpp"
#include "geometry/position_check.hpp"
#include "grid/plain_cells.hpp"
#include "lists/list_assembly.hpp"
#include "lists/list_check.hpp"
#include "lists/pair_filter.hpp"

namespace dch {
namespace {

using detail::seconds_since;

class CellSearch final : public PairSearch {
 public:
  CellSearch(double radius, int divisions) : radius_(radius), cells_(divisions) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override;
  void list(const ListParams& params, NeighborList& out) override;
  using PairSearch::list;
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return "cell"; }

 private:
  void clear();
  void take(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys);
  std::size_t memory_bytes() const;

  double radius_;
  std::vector<Vec3> positions_;  ///< as given
  Box box_;
  double wrap_error_ = 0;
  detail::PlainCells cells_;
  SearchStats stats_;

  detail::KeyTable key_table_;
  std::vector<Vec3> wrapped_;
  detail::PairBuffer pairs_;
  detail::ListAssembler assembler_;
};

void CellSearch::clear() {
  positions_.clear();
  cells_.clear();
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
  cells_.build(wrapped_, box, radius_ + wrap_error_);
  positions_.assign(positions.begin(), positions.end());
  box_ = box;
}

void CellSearch::list(const ListParams& params, NeighborList& out) {
  const auto start = std::chrono::steady_clock::now();
  detail::check_list_params(params, positions_.size(), radius_);
  detail::make_or_empty({&out}, [&] {
    const detail::PairFilter filter(positions_, box_, params, wrap_error_ + params.cutoff_error());
    pairs_.clear();
    cells_.find_rows(box_, filter, [&](std::int32_t i, Span<const std::int32_t> others) {
      for (const std::int32_t j : others) pairs_.add(i, j);
    });
    assembler_.assemble(positions_.size(), params.kind, params.first_ghost, pairs_, out);
  });
  stats_.list_seconds += seconds_since(start);
  stats_.memory_bytes = memory_bytes();
}

std::size_t CellSearch::memory_bytes() const {
  return (positions_.capacity() + wrapped_.capacity()) * sizeof(Vec3) + cells_.memory_bytes() +
         pairs_.memory_bytes() + assembler_.memory_bytes();
}

}  // namespace

std::unique_ptr<PairSearch> make_cell_search(double radius, int divisions) {
  constexpr double kMinRadius = 1e-100;  // squares of shorter ones would underflow
  if (!(std::isfinite(radius) && radius >= kMinRadius)) {
    throw InvalidParameter("the search radius is " + detail::describe(radius) +
                           "; it must be finite and at least " + detail::describe(kMinRadius));
  }
  if (divisions < 1 || divisions > 4) {
    throw InvalidParameter("cells of 1/" + std::to_string(divisions) +
                           " of the radius are not supported; divisions must be 1 to 4");
  }
  return std::make_unique<CellSearch>(radius, divisions);
}

}  // namespace dch

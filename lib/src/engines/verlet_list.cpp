// SPDX-License-Identifier: MIT
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/verlet_list.hpp>

namespace dch {

VerletList::VerletList(std::unique_ptr<PairSearch> search, ListParams params)
    : search_(std::move(search)), params_(std::move(params)), stale_test_(params_.skin) {
  if (!search_)
    throw InvalidParameter("no search engine given; make one with make_dch_search or make_cell_search");
}

bool VerletList::update(Span<const Vec3> positions, const Box& box) {
  if (!is_stale(positions, box)) return false;
  stale_test_.forget();
  search_->update(positions, box);
  search_->list(params_, list_);
  stale_test_.remember(positions, box);
  ++rebuilds_;
  return true;
}

}  // namespace dch

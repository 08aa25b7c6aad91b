// SPDX-License-Identifier: MIT
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/verlet_list.hpp>

namespace dch {

VerletList::VerletList(std::unique_ptr<PairSearch> search, ListParams params, Expiry expiry)
    : search_(std::move(search)), params_(std::move(params)), expiry_(params_.skin, expiry) {
  if (!search_)
    throw InvalidParameter("no search engine given; make one with make_dch_search or make_cell_search");
}

bool VerletList::is_stale(Span<const Vec3> positions, const Box& box) const {
  return expiry_.is_stale(positions, box, params_, *search_);
}

bool VerletList::update(Span<const Vec3> positions, const Box& box) {
  if (!is_stale(positions, box)) return false;
  expiry_.forget();
  search_->update(positions, box);
  search_->list(params_, list_);
  expiry_.remember(positions, box, params_);
  ++rebuilds_;
  return true;
}

}  // namespace dch

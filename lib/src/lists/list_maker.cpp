// SPDX-License-Identifier: MIT
#include <algorithm>

#include <dch/lists/list_maker.hpp>

#include "geometry/tolerance.hpp"
#include "hierarchy/structure.hpp"
#include "leaves/leaf_source.hpp"
#include "lists/leaf_rows.hpp"
#include "lists/list_assembly.hpp"
#include "lists/list_check.hpp"
#include "lists/list_finder.hpp"
#include "lists/reach.hpp"

namespace dch {

struct ListMaker::Impl {
  detail::LeafSource source;
  detail::LeafRows rows;
  detail::ListFinder finder;

  void lists(const detail::Structure& hierarchy, Span<const ListParams> requests,
             const std::vector<NeighborList*>& out) {
    double reach = 0, host_error = 0;
    for (const ListParams& request : requests) {
      detail::check_list_params(request, hierarchy.raw.size(), hierarchy.params.radius);
      reach = std::max(reach, request.list_radius());
      host_error = std::max(host_error, request.cutoff_error());
    }
    detail::make_or_empty(out, [&] {
      source.structure = &hierarchy;
      detail::LeafSource* const sources[] = {&source};
      const double error = detail::distance_error(hierarchy) + host_error;
      const detail::ListScene scene{hierarchy.box,
                                    {sources, 1},
                                    {(reach + error) * detail::kInflate},
                                    error,
                                    hierarchy.params.executor};
      const std::vector<std::int32_t> singletons = hierarchy.singleton_ids();
      finder.find(
          {hierarchy.raw, hierarchy.box, error, singletons}, requests,
          [&](const auto& filters, const auto& lists) { rows.find(scene, filters, lists); }, out);
    });
  }
};

ListMaker::ListMaker() : impl_(std::make_unique<Impl>()) {}
ListMaker::~ListMaker() = default;
ListMaker::ListMaker(ListMaker&&) noexcept = default;
ListMaker& ListMaker::operator=(ListMaker&&) noexcept = default;

void ListMaker::list(const HierarchyView& hierarchy, const ListParams& params, NeighborList& out) {
  impl_->lists(hierarchy.structure(), {&params, 1}, {&out});
}

void ListMaker::lists(const HierarchyView& hierarchy, Span<const ListParams> requests,
                      std::vector<NeighborList>& out) {
  out.resize(requests.size());
  std::vector<NeighborList*> each;
  each.reserve(out.size());
  for (NeighborList& list : out) each.push_back(&list);
  impl_->lists(hierarchy.structure(), requests, each);
}

ListWork ListMaker::work() const { return impl_->rows.work(); }
std::size_t ListMaker::memory_bytes() const {
  return impl_->source.memory_bytes() + impl_->rows.memory_bytes() + impl_->finder.memory_bytes();
}

}  // namespace dch

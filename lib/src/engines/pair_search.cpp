// SPDX-License-Identifier: MIT
#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

namespace dch {

void PairSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r) list(requests[r], out[r]);
}

void PairSearch::list_in_pieces(const ListParams& params,
                                const std::function<void(const NeighborList&)>& use) {
  ListParams request = params;
  request.kind = ListKind::half;
  request.order = RowOrder::unsorted;
  use(list(request));
}

void PairSearch::cluster_pairs(const ListParams&, ClusterPairs&) {
  throw InvalidParameter("the engine '" + name() +
                         "' makes no cluster pairs; take a neighbor list, or another engine");
}

UnlistedPair PairSearch::unlisted_pair(const UnlistedQuestion&) { return UnlistedPair::unknown; }

}  // namespace dch

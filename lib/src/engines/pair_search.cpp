// SPDX-License-Identifier: MIT
#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

namespace dch {

void PairSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r) list(requests[r], out[r]);
}

void PairSearch::cluster_pairs(const ListParams&, ClusterPairs&) {
  throw InvalidParameter("the engine '" + name() +
                         "' makes no cluster pairs; take a neighbor list, or another engine");
}

}  // namespace dch

// SPDX-License-Identifier: MIT
#include <dch/engines/pair_search.hpp>

namespace dch {

void PairSearch::lists(Span<const ListParams> requests, std::vector<NeighborList>& out) {
  out.resize(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r) list(requests[r], out[r]);
}

}  // namespace dch

// SPDX-License-Identifier: MIT
// Stands in for the library's cell search when it is linked first: all pairs, but one pair is lost and one
// invented.
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

namespace dch {
namespace {

class FaultySearch final : public PairSearch {
 public:
  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t>) override {
    positions_.assign(positions.begin(), positions.end());
    box_ = box;
    ++stats_.builds;
  }
  using PairSearch::list;
  void list(const ListParams& params, NeighborList& out) override {
    out = all_pairs(positions_, box_, params);
    if (stats_.builds != 3) return;  // only the third frame is wrong
    lose_first_pair(out);
    invent_pair(out);
  }
  const SearchStats& stats() const override { return stats_; }
  std::string name() const override { return "cell"; }

 private:
  static void lose_first_pair(NeighborList& list) {
    list.j.erase(list.j.begin());
    for (std::int64_t& begin : list.first) begin -= begin > 0 ? 1 : 0;
  }
  /// Joins the first atom to one that is none of its neighbors.
  static void invent_pair(NeighborList& list) {
    const auto last = static_cast<std::int32_t>(list.size() - 1);
    list.j.insert(list.j.begin() + static_cast<std::ptrdiff_t>(list.first[1]), last);
    for (std::size_t i = 1; i < list.first.size(); ++i) ++list.first[i];
  }

  std::vector<Vec3> positions_;
  Box box_;
  SearchStats stats_;
};

}  // namespace

std::unique_ptr<PairSearch> make_cell_search(double, int) { return std::make_unique<FaultySearch>(); }

}  // namespace dch

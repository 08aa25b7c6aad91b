// SPDX-License-Identifier: MIT
//
// libgromacs's AnalysisNeighborhood, the search that GROMACS offers to programs that analyse trajectories: a
// grid, in float. It hands out one pair after the other; they are put into an array here.
#include <gromacs/math/vectypes.h>
#include <gromacs/pbcutil/pbc.h>
#include <gromacs/selection/nbsearch.h>
#include <utility>
#include <vector>

#include "peer_lists.hpp"

namespace dch::bench {
namespace {

class GromacsSearch : public PeerLists {
 public:
  explicit GromacsSearch(const Scene& scene) : exclusions_(scene.exclusions) {
    neighborhood_.setCutoff(static_cast<real>(scene.list_radii.back()));
    take(scene);
  }

  std::string name() const override { return "GROMACS AnalysisNeighborhood"; }
  void take(const Scene& scene) override {
    matrix box = {};
    for (int axis = 0; axis < 3; ++axis) box[axis][axis] = static_cast<real>(scene.box.vector(axis)[axis]);
    set_pbc(&pbc_, PbcType::Xyz, box);
    positions_.clear();
    for (const Vec3& position : scene.positions) {
      const Vec3 p = scene.box.wrap(position);
      positions_.emplace_back(static_cast<real>(p.x), static_cast<real>(p.y), static_cast<real>(p.z));
    }
  }
  void make() override {
    pairs_.clear();
    gmx::AnalysisNeighborhoodSearch search =
        neighborhood_.initSearch(&pbc_, gmx::AnalysisNeighborhoodPositions(positions_));
    gmx::AnalysisNeighborhoodPairSearch found = search.startSelfPairSearch();
    gmx::AnalysisNeighborhoodPair pair;
    while (found.findNextPair(&pair)) pairs_.emplace_back(pair.refIndex(), pair.testIndex());
  }
  PairSum pairs_within(const Scene& scene) const override {
    const double radius = scene.list_radii.back();
    PairSum sum;
    for (const auto& [a, b] : pairs_) {
      const auto i = static_cast<std::size_t>(std::min(a, b)), j = static_cast<std::size_t>(std::max(a, b));
      if (exclusions_.excluded(a, b)) continue;
      if (scene.box.distance2(scene.positions[i], scene.positions[j]) <= radius * radius) sum.add(a, b);
    }
    return sum;
  }
  std::int64_t pairs_held() const override { return static_cast<std::int64_t>(pairs_.size()); }

 private:
  const Exclusions& exclusions_;
  gmx::AnalysisNeighborhood neighborhood_;
  t_pbc pbc_;
  std::vector<gmx::RVec> positions_;
  std::vector<std::pair<int, int>> pairs_;
};

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) {
  return dch::bench::run_beside(argc, argv, [](const dch::bench::Scene& scene) {
    return std::make_unique<dch::bench::GromacsSearch>(scene);
  });
}

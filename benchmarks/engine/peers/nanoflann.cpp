// SPDX-License-Identifier: MIT
//
// nanoflann's k-d tree, in double. It knows no periodic box, so the images of the points near the faces are
// added to the tree; a tree for each configuration, and a query by radius for each particle.
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <vector>

#include "peer_lists.hpp"
#include "stopwatch.hpp"

namespace dch::bench {
namespace {

/// Points as nanoflann reads them.
struct Cloud {
  std::vector<Vec3> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t k, std::size_t axis) const { return points[k][static_cast<int>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

/// Takes what a query finds: the pairs of particle i with those of higher numbers.
class Row {
 public:
  Row(double square, std::int32_t i, const std::vector<std::int32_t>& particle,
      std::vector<std::int32_t>& out)
      : square_(square), i_(i), particle_(particle), out_(out), begin_(out.size()) {}
  std::size_t size() const { return out_.size() - begin_; }
  bool full() const { return true; }
  double worstDist() const { return square_; }
  bool addPoint(double distance2, std::uint32_t k) {
    if (distance2 < square_ && particle_[k] > i_) out_.push_back(particle_[k]);
    return true;
  }

 private:
  double square_;
  std::int32_t i_;
  const std::vector<std::int32_t>& particle_;
  std::vector<std::int32_t>& out_;
  std::size_t begin_;
};

class NanoflannLists : public PeerLists {
 public:
  explicit NanoflannLists(const Scene& scene)
      : radius_(scene.list_radii.back()), exclusions_(scene.exclusions) {
    double best = std::numeric_limits<double>::infinity();
    int best_leaf = kLeaves[0];
    take(scene);
    for (const int leaf : kLeaves) {
      leaf_ = leaf;
      const double seconds = seconds_of([this] { make(); });
      if (seconds >= best) continue;
      best = seconds;
      best_leaf = leaf;
    }
    leaf_ = best_leaf;
  }

  std::string name() const override { return "nanoflann k-d tree"; }
  void take(const Scene& scene) override {
    wrapped_.clear();
    for (const Vec3& p : scene.positions) wrapped_.push_back(scene.box.wrap(p));
    for (int axis = 0; axis < 3; ++axis) lengths_[axis] = scene.box.vector(axis)[axis];
  }
  void make() override;
  PairSum pairs_within(const Scene&) const override {
    PairSum sum;
    for (std::size_t i = 0; i + 1 < first_.size(); ++i)
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k)
        if (!exclusions_.excluded(static_cast<std::int32_t>(i), neighbors_[k]))
          sum.add(static_cast<std::int32_t>(i), neighbors_[k]);
    return sum;
  }
  std::int64_t pairs_held() const override { return static_cast<std::int64_t>(neighbors_.size()); }
  bool in_double() const override { return true; }

 private:
  static constexpr int kLeaves[] = {6, 10, 16, 24, 40};  ///< points in a leaf, of which the fastest is kept

  void add_images();

  double radius_;
  const Exclusions& exclusions_;
  int leaf_ = kLeaves[0];
  Vec3 lengths_;
  std::vector<Vec3> wrapped_;
  Cloud cloud_;
  std::vector<std::int32_t> particle_;  ///< by point of the cloud
  std::vector<std::size_t> first_;
  std::vector<std::int32_t> neighbors_;
};

/// Axis by axis, so that those at edges and corners are images of images.
void NanoflannLists::add_images() {
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t count = cloud_.points.size();
    for (std::size_t k = 0; k < count; ++k) {
      const double at = cloud_.points[k][axis];
      const double shift = at < radius_                    ? lengths_[axis]
                           : at > lengths_[axis] - radius_ ? -lengths_[axis]
                                                           : 0;
      if (shift == 0) continue;
      Vec3 image = cloud_.points[k];
      image[axis] += shift;
      cloud_.points.push_back(image);
      particle_.push_back(particle_[k]);
    }
  }
}

void NanoflannLists::make() {
  const std::size_t count = wrapped_.size();
  cloud_.points = wrapped_;
  particle_.resize(count);
  for (std::size_t i = 0; i < count; ++i) particle_[i] = static_cast<std::int32_t>(i);
  add_images();
  const Tree tree(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(static_cast<std::size_t>(leaf_)));
  first_.assign(1, 0);
  neighbors_.clear();
  const nanoflann::SearchParams unsorted(0, 0, false);
  for (std::size_t i = 0; i < count; ++i) {
    Row row(radius_ * radius_, static_cast<std::int32_t>(i), particle_, neighbors_);
    tree.radiusSearchCustomCallback(&wrapped_[i].x, row, unsorted);
    first_.push_back(neighbors_.size());
  }
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) {
  return dch::bench::run_beside(argc, argv, [](const dch::bench::Scene& scene) {
    return std::make_unique<dch::bench::NanoflannLists>(scene);
  });
}

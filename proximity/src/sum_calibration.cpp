// SPDX-License-Identifier: MIT
#include "sum_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dch::detail {
namespace {

constexpr std::size_t kTargets = 48;

/// Descends to some of the nodes at the bottom.
class SampledDescent {
 public:
  explicit SampledDescent(const ChargedTree& tree) : is_wanted_(tree.nodes().size(), false) {
    const auto& nodes = tree.nodes();
    std::vector<std::size_t> bottom;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k].is_bottom()) bottom.push_back(k);
    const std::size_t taken = std::min(kTargets, bottom.size());
    for (std::size_t k = 0; k < taken; ++k) is_wanted_[bottom[k * bottom.size() / taken]] = true;
    for (std::size_t k = nodes.size(); k-- > 0;)
      for (std::int32_t c = 0; c < nodes[k].children; ++c) {
        const std::int32_t child = nodes[k].first_child + c;
        if (is_wanted_[static_cast<std::size_t>(child)]) is_wanted_[k] = true;
      }
  }

  /// The largest error over the potential.
  double error(const SumScene& scene) const { return error_below(scene, 0, root_sources(scene), 0); }

 private:
  double error_below(const SumScene& scene, std::int32_t target, Span<const SumSource> sources,
                     double error) const {
    Interactions found;
    take_sources(scene, target, sources, error, found);
    const ChargedNode& node = scene.tree.node(target);
    if (node.is_bottom()) return error > 0 ? error / scene.least[static_cast<std::size_t>(target)] : 0;
    double largest = 0;
    for (std::int32_t child = node.first_child; child < node.first_child + node.children; ++child)
      if (is_wanted_[static_cast<std::size_t>(child)])
        largest = std::max(largest, error_below(scene, child, found.rest, error));
    return largest;
  }

  std::vector<bool> is_wanted_;
};

}  // namespace

double share_for(SumScene scene) {
  const SampledDescent descent(scene.tree);
  const double aim = 0.9 * std::exchange(scene.most, 1e300);
  scene.share = 0.01 * aim;
  for (int k = 0; k < 6; ++k) {
    const double error = descent.error(scene);
    if (error == 0) break;  // nothing is far, or without an error
    if (error <= aim && error >= 0.85 * aim) break;
    scene.share *= std::clamp(aim / error, 0.01, 100.0);
  }
  return scene.share;
}

}  // namespace dch::detail

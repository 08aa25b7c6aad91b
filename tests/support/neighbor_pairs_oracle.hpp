// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include <dch/engines/neighbor_pairs.hpp>

/// Brute force over images of the cell as given. It shares no code with the library.
namespace dch::images {

using Shift = NeighborPairs::Shift;
using Pair = std::tuple<std::int32_t, std::int32_t, Shift>;

inline Vec3 displacement(Vec3 from, Vec3 to, const Box& box, const Shift& s) {
  Vec3 d = to - from;
  for (int axis = 0; axis < 3; ++axis)
    if (box.periodic(axis)) d = d + static_cast<double>(s[static_cast<std::size_t>(axis)]) * box.vector(axis);
  return d;
}

/// For the component f of a displacement along a cell vector, images within the reach have |f + n| <= reach /
/// height. Found from the vectors as given, without any reduction.
class ImageRanges {
 public:
  ImageRanges(const Box& box, double reach) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!box.periodic(axis)) continue;
      Vec3 g = box.vector(axis);  // made normal to the other periodic vectors, by Gram and Schmidt
      std::vector<Vec3> others;
      for (int k = 0; k < 3; ++k)
        if (k != axis && box.periodic(k)) others.push_back(box.vector(k));
      if (others.size() == 2) {
        g = cross(others[0], others[1]);
      } else if (others.size() == 1) {
        g = g - (dot(g, others[0]) / norm2(others[0])) * others[0];
      }
      g = (1 / dot(g, box.vector(axis))) * g;
      normal_[static_cast<std::size_t>(axis)] = g;
      reach_[static_cast<std::size_t>(axis)] = reach * std::sqrt(norm2(g)) + 1e-6;
    }
  }

  template <class F>
  void for_each(Vec3 d, const F& f) const {
    std::array<int, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = static_cast<int>(std::ceil(-reach_[k] - dot(normal_[k], d)));
      high[k] = static_cast<int>(std::floor(reach_[k] - dot(normal_[k], d)));
    }
    for (int a = low[0]; a <= high[0]; ++a)
      for (int b = low[1]; b <= high[1]; ++b)
        for (int c = low[2]; c <= high[2]; ++c) f(Shift{a, b, c});
  }

 private:
  std::array<Vec3, 3> normal_{};
  std::array<double, 3> reach_{};
};

struct Scene {
  Box box;
  std::vector<Vec3> points;
  NeighborPairsParams params;
};

inline double cutoff_of(const Scene& scene, std::size_t i, std::size_t j) {
  if (!scene.params.radii.empty()) return scene.params.radii[i] + scene.params.radii[j];
  if (scene.params.types.empty()) return scene.params.cutoffs.largest();
  return scene.params.cutoffs(scene.params.types[i], scene.params.types[j]);
}

/// The oracle: every pair, every image.
inline std::vector<Pair> brute_force(const Scene& scene, double reach) {
  const ImageRanges images(scene.box, reach);
  std::vector<Pair> pairs;
  const auto n = static_cast<std::int32_t>(scene.points.size());
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t j = 0; j < n; ++j) {
      const Vec3 from = scene.points[i], to = scene.points[j];
      const double cutoff = cutoff_of(scene, i, j);
      images.for_each(to - from, [&](const Shift& s) {
        if (i == j && s == Shift{}) return;
        if (scene.params.kind == ListKind::half && (i > j || (i == j && s < Shift{}))) return;
        if (cutoff == 0 && scene.params.radii.empty()) return;
        if (norm2(displacement(from, to, scene.box, s)) <= cutoff * cutoff) pairs.push_back({i, j, s});
      });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace dch::images

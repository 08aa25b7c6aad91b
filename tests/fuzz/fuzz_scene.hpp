// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "fuzz_input.hpp"
#include "scenes.hpp"

namespace dch::fuzz {

/// A box of one of the kinds, with edges of 3 to 12, or one whose vectors are free.
/// @throws InvalidBox if those vectors make none.
inline Box choose_box(FuzzInput& input) {
  const auto boxes = scenes::all_boxes(input.uniform(3, 12));
  const std::size_t which = input.below(boxes.size() + 1);
  if (which < boxes.size()) return boxes[which].box;
  const Vec3 a = input.in_cube(8), b = input.in_cube(8), c = input.in_cube(8);
  const std::uint8_t open = input.byte();
  return Box::triclinic(a, b, c, {(open & 1) == 0, (open & 2) == 0, (open & 4) == 0}, input.in_cube(20));
}

/// A point of the cell, at times on its boundary, at times many cells away, at times on one of those before.
inline Vec3 choose_point(FuzzInput& input, const Box& box, const std::vector<Vec3>& before) {
  switch (input.below(8)) {
    case 0:
      if (!before.empty()) return before[input.below(std::min<std::size_t>(before.size(), 65536))];
      break;
    case 1:
      if (!before.empty()) return before.back() + input.in_cube(0.5);
      break;
    case 2:
      return scenes::from_fractional(
          box, {std::floor(input.uniform(-3, 4)), input.uniform(), input.uniform(-40, 40)});
    default:
      break;
  }
  return scenes::from_fractional(box, {input.uniform(), input.uniform(), input.uniform()});
}

/// Points, and a request for a list of them.
struct Scene {
  Box box;
  double reach = 1;  ///< largest list radius [length]
  std::vector<Vec3> points;
  std::vector<double> radii;
  std::vector<std::int32_t> types;
  Exclusions exclusions;
  ListParams request;
};

/// Cutoffs by one number, by types or by radii; the largest list radius is the reach of the scene.
inline void choose_sizes(FuzzInput& input, Scene& scene) {
  ListParams& request = scene.request;
  request.skin = input.coin() ? 0.0 : scene.reach * input.uniform(0, 0.5);
  const double largest = scene.reach - request.skin;
  request.cutoffs = TypeCutoffs(largest);
  const std::size_t kind = input.below(3);
  if (kind == 1) {
    const std::size_t types = 1 + input.below(20);
    std::vector<double> matrix(types * types, 0.0);
    for (std::size_t a = 0; a < types; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        matrix[a * types + b] = matrix[b * types + a] = largest * std::max(0.0, input.uniform(-0.2, 1));
    matrix[0] = largest;
    request.cutoffs = TypeCutoffs(static_cast<int>(types), matrix);
    for (std::size_t k = 0; k < scene.points.size(); ++k)
      scene.types.push_back(static_cast<std::int32_t>(input.below(types)));
    request.types = scene.types;
  } else if (kind == 2 && !scene.points.empty()) {
    const double ratio = std::pow(100, input.uniform());
    for (std::size_t k = 0; k < scene.points.size(); ++k)
      scene.radii.push_back(0.5 * largest * std::pow(ratio, -input.uniform()));
    request.radii = scene.radii;
  }
}

inline void choose_rest_of_request(FuzzInput& input, Scene& scene) {
  ListParams& request = scene.request;
  request.kind = input.coin() ? ListKind::full : ListKind::half;
  const std::size_t n = scene.points.size();
  if (input.coin() && n > 1) {
    std::vector<IndexPair> bonds;
    for (std::size_t k = input.below(2 * n); k > 0; --k) {
      const auto a = static_cast<std::int32_t>(input.below(n)), b = static_cast<std::int32_t>(input.below(n));
      if (a != b) bonds.push_back({std::min(a, b), std::max(a, b)});
    }
    scene.exclusions = Exclusions::from_bonds(n, bonds, 1 + static_cast<int>(input.below(3)));
    request.exclusions = &scene.exclusions;
  }
  if (input.below(4) == 1) request.first_ghost = static_cast<std::int32_t>(input.below(n + 1));
}

/// At most `most` points. The request refers to the scene, which therefore is filled in place.
/// @throws InvalidBox.
inline void choose_scene(FuzzInput& input, std::size_t most, Scene& scene) {
  scene.box = choose_box(input);
  const double widest = std::min(3.0, 0.98 * scene.box.max_cutoff());
  scene.reach = widest * std::pow(10, -input.uniform());
  const std::size_t count = input.below(most + 1);
  for (std::size_t k = 0; k < count; ++k)
    scene.points.push_back(choose_point(input, scene.box, scene.points));
  choose_sizes(input, scene);
  choose_rest_of_request(input, scene);
}

/// Moves some points or all, by little or much.
inline void move_points(FuzzInput& input, double reach, std::vector<Vec3>& points) {
  const double motion = reach * std::pow(10, input.uniform(-3, 0.5));
  const bool some = input.coin();
  const Vec3 drift = input.in_cube(motion);
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = points[k] + (some && (k & 7) != 0 ? drift : input.in_cube(motion));
}

}  // namespace dch::fuzz

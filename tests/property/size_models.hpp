// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/list_params.hpp>

#include "scenes.hpp"

/// Particles of different sizes, and the engines that list them.
namespace dch::sizes {

inline constexpr double kSide = 9, kLargestRadius = 1.2, kSkin = 0.3;
inline constexpr double kReach = 2 * kLargestRadius + kSkin;  // below half the smallest height of all boxes

/// Radii of particles, or types and a matrix; both own what ListParams views.
struct SizeModel {
  std::string name;
  std::vector<double> radii;
  std::vector<std::int32_t> types;
  TypeCutoffs cutoffs{1.0};

  ListParams params() const {
    ListParams list;
    list.skin = kSkin;
    list.radii = radii;
    list.types = types;
    list.cutoffs = cutoffs;
    return list;
  }
  double reach(std::size_t i, std::size_t j) const {
    return kSkin + (radii.empty() ? cutoffs(types[i], types[j]) : radii[i] + radii[j]);
  }
};

inline std::vector<SizeModel> size_models(std::size_t n) {
  scenes::Random random(7);
  const auto by_radii = [&](const std::string& name, const auto& radius) {
    SizeModel model{name, {}, {}, TypeCutoffs(1.0)};
    for (std::size_t i = 0; i < n; ++i) model.radii.push_back(kLargestRadius * radius(i));
    return model;
  };
  const auto by_types = [&](const std::string& name, int types, std::vector<double> matrix) {
    SizeModel model{name, {}, {}, TypeCutoffs(types, std::move(matrix))};
    for (std::size_t i = 0; i < n; ++i)
      model.types.push_back(static_cast<std::int32_t>(i % 7 == 0 ? 0 : random.below(std::size_t(types))));
    return model;
  };
  std::vector<double> many(20 * 20);
  for (int a = 0; a < 20; ++a)
    for (int b = 0; b < 20; ++b) many[static_cast<std::size_t>(20 * a + b)] = 0.05 * (a + b) + 0.1;
  return {
      by_radii("equal radii", [](std::size_t) { return 1.0; }),
      by_radii("radii 1:10", [](std::size_t i) { return i % 29 == 0 ? 1.0 : 0.1; }),
      by_radii("radii 1:50", [](std::size_t i) { return i % 97 == 0 ? 1.0 : 0.02; }),
      by_radii("radii 1:20, continuous", [&](std::size_t) { return std::pow(20, random.uniform() - 1); }),
      by_radii("radii 1:100, and none",
               [&](std::size_t i) { return i % 5 == 1 ? 0.0 : std::pow(100, random.uniform() - 1); }),
      by_types("types 1:3", 2, {2.4, 1.6, 1.6, 0.8}),
      by_types("types 1:20", 2, {2.4, 1.3, 1.3, 0.12}),
      by_types("types without pairs", 3, {2.4, 0.0, 1.0, 0.0, 0.0, 0.5, 1.0, 0.5, 0.1}),
      by_types("20 types", 20, many),
  };
}

enum class Engine { one_hierarchy, hierarchy_by_class, grid };
inline constexpr Engine kEngines[] = {Engine::one_hierarchy, Engine::hierarchy_by_class, Engine::grid};

inline std::string text(Engine engine) {
  return engine == Engine::one_hierarchy ? ", one" : engine == Engine::grid ? ", grid" : ", classes";
}

inline std::unique_ptr<PairSearch> search_with(Engine engine, Executor* executor = nullptr,
                                               double radius = kReach) {
  if (engine == Engine::grid) return make_grid_search(radius, executor);
  HierarchyParams params;
  params.radius = radius;
  params.size_classes = engine == Engine::hierarchy_by_class;
  params.executor = executor;
  return make_dch_search(params);
}

}  // namespace dch::sizes

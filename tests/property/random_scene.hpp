// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>

#include "instruction_sets.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"

namespace dch {

/// A host that lists just some of the pairs that are near their cutoffs.
class SomeNearCutoff : public TieBreaker {
 public:
  SomeNearCutoff(double error, const std::vector<Vec3>& points, const Box& box, const ListParams& request)
      : TieBreaker(error), points_(points), box_(box), request_(request) {}

  bool accepts(std::int32_t i, std::int32_t j) const override {
    const double off = std::sqrt(box_.distance2(points_[i], points_[j])) - cutoff(i, j) - request_.skin;
    if (std::abs(off) > error()) return off < 0;
    return (i + j) % 3 == 0;
  }

 private:
  double cutoff(std::int32_t i, std::int32_t j) const {
    if (!request_.radii.empty()) return request_.radii[i] + request_.radii[j];
    return request_.types.empty() ? request_.cutoffs(0, 0)
                                  : request_.cutoffs(request_.types[i], request_.types[j]);
  }

  const std::vector<Vec3>& points_;
  const Box& box_;
  const ListParams& request_;
};

/// A scene in which nothing is chosen by hand: the box, the points, their sizes, what is asked for and how.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    const auto boxes = scenes::all_boxes(random_.uniform(3, 12));
    box_ = boxes[random_.below(boxes.size())];
    const double widest = std::min(3.0, 0.98 * box_.box.max_cutoff());
    reach_ = widest * std::pow(10, -random_.uniform());
    const auto sets = scenes::hard_point_sets(box_.box, random_.below(300), 0.4 * reach_ + 0.05);
    const scenes::NamedPoints& set = sets[random_.below(sets.size())];
    points_ = set.points;
    what_ = "seed " + std::to_string(seed) + ": " + std::to_string(points_.size()) + " points, " + set.name +
            ", " + box_.name;
    choose_sizes();
    choose_request();
    choose_search();
  }

  /// Lists at the first positions and after some motions, small and large, against all pairs.
  void check() {
    const RestoreInstructionSet restore;
    set_instruction_set(one_of(supported_sets()));
    const auto search = make_dch_search(hierarchy_);
    const auto grid = make_grid_search(hierarchy_.radius, threads_.get());
    const auto chosen = make_auto_search(hierarchy_);
    for (int step = 0; step < 4; ++step) {
      const double motion = reach_ * std::pow(10, random_.uniform(-3, 0.5));
      for (Vec3& p : points_)
        if (step > 0) p = p + random_.in_cube(motion);
      const NeighborList expected = all_pairs(points_, box_.box, request_);
      for (PairSearch* const engine : {search.get(), grid.get(), chosen.get()}) {
        engine->update(points_, box_.box);
        const NeighborList list = engine->list(request_);
        ASSERT_EQ(first_difference(
                      request_.order == RowOrder::unsorted ? sorted_by_index(list, points_.size()) : list,
                      expected),
                  "")
            << engine->name() << ", step " << step << ", " << what_;
      }
    }
    ASSERT_EQ(search->validate(), "") << what_;
  }

 private:
  bool coin() { return random_.below(2) == 1; }
  template <class T>
  T one_of(const std::vector<T>& items) {
    return items[random_.below(items.size())];
  }

  /// Cutoffs with the skin up to reach_.
  void choose_sizes() {
    request_.skin = coin() ? 0.0 : reach_ * random_.uniform(0, 0.5);
    const double largest = reach_ - request_.skin;
    request_.cutoffs = TypeCutoffs(largest);
    switch (random_.below(4)) {
      case 0:
        what_ += ", one cutoff";
        return;
      case 1: {
        const std::size_t types = 1 + random_.below(coin() ? 4 : 24);
        std::vector<double> matrix(types * types, 0.0);
        for (std::size_t a = 0; a < types; ++a)
          for (std::size_t b = 0; b <= a; ++b)
            matrix[a * types + b] = matrix[b * types + a] =
                random_.below(5) == 0 ? 0.0 : largest * std::pow(30, -random_.uniform());
        matrix[0] = largest;
        request_.cutoffs = TypeCutoffs(static_cast<int>(types), matrix);
        for (std::size_t i = 0; i < points_.size(); ++i)
          types_.push_back(static_cast<std::int32_t>(random_.below(types)));
        request_.types = types_;
        what_ += ", " + std::to_string(types) + " types";
        return;
      }
      default: {
        const double ratio = std::pow(100, random_.uniform());
        const bool are_two = coin();
        for (std::size_t i = 0; i < points_.size(); ++i) {
          const double smaller = are_two ? static_cast<double>(random_.below(20) > 0) : random_.uniform();
          radii_.push_back(0.5 * largest * std::pow(ratio, -smaller));
        }
        request_.radii = radii_;
        what_ += std::string(are_two ? ", two sizes" : ", continuous sizes") + " 1:" + std::to_string(ratio);
      }
    }
  }

  void choose_request() {
    request_.kind = coin() ? ListKind::full : ListKind::half;
    if (coin() && points_.size() > 1) {
      std::vector<IndexPair> bonds;
      for (std::size_t k = random_.below(points_.size()); k > 0; --k) {
        const auto a = static_cast<std::int32_t>(random_.below(points_.size())),
                   b = static_cast<std::int32_t>(random_.below(points_.size()));
        if (a != b) bonds.push_back({std::min(a, b), std::max(a, b)});
      }
      exclusions_ = Exclusions::from_bonds(points_.size(), bonds, 1 + static_cast<int>(random_.below(3)));
      request_.exclusions = &exclusions_;
      what_ += ", exclusions";
    }
    if (random_.below(4) == 0) {
      request_.first_ghost = static_cast<std::int32_t>(random_.below(points_.size() + 1));
      what_ += ", ghosts from " + std::to_string(request_.first_ghost);
    }
    if (request_.kind == ListKind::half && coin()) request_.order = RowOrder::unsorted;
    if (random_.below(4) == 0) {
      tie_breaker_ = std::make_unique<SomeNearCutoff>(0.01 * reach_, points_, box_.box, request_);
      request_.tie_breaker = tie_breaker_.get();
      what_ += ", a test near the cutoff";
    }
  }

  void choose_search() {
    hierarchy_.radius = reach_ * (1 + 1e-12) + request_.cutoff_error();
    hierarchy_.size_classes = coin();
    if (coin()) hierarchy_.base_radius = reach_ * random_.uniform(0.2, 2);
    hierarchy_.policy =
        one_of<MaintenancePolicy>({MaintenancePolicy::automatic, MaintenancePolicy::automatic,
                                   MaintenancePolicy::always_repair, MaintenancePolicy::always_rebuild});
    threads_ = make_thread_pool(1 + static_cast<int>(random_.below(3)));
    hierarchy_.executor = threads_.get();
    what_ += hierarchy_.size_classes ? ", classes" : "";
  }

  scenes::Random random_;
  scenes::NamedBox box_;
  double reach_ = 1;  ///< largest list radius [length]
  std::vector<Vec3> points_;
  std::vector<double> radii_;
  std::vector<std::int32_t> types_;
  Exclusions exclusions_;
  ListParams request_;
  std::unique_ptr<TieBreaker> tie_breaker_;
  StructureParams hierarchy_;
  std::unique_ptr<Executor> threads_;
  std::string what_;
};

}  // namespace dch

// SPDX-License-Identifier: MIT
//
// The hierarchy under any sequence of its operations: every invariant holds after each of them, lists are
// those of all pairs, and so are nearest neighbors, by what is kept up between the operations too.
#include <limits>
#include <memory>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/executor.hpp>
#include <dch/lists/all_pairs.hpp>
#include <dch/proximity/nearest.hpp>

#include "fuzz_scene.hpp"
#include "list_compare.hpp"
#include "listed_hierarchy.hpp"

namespace dch::fuzz {
namespace {

constexpr std::size_t kMaxPoints = 48;
constexpr int kMaxOperations = 24;

StructureParams choose_params(FuzzInput& input, double radius) {
  StructureParams params;
  params.radius = radius;
  if (input.coin()) params.base_radius = radius * input.uniform(0.2, 2);
  if (input.below(4) == 1) params.edge_rule = EdgeRule::thesis, params.base_radius = 0;
  constexpr MaintenancePolicy kPolicies[] = {MaintenancePolicy::automatic, MaintenancePolicy::automatic,
                                             MaintenancePolicy::always_repair,
                                             MaintenancePolicy::always_rebuild};
  params.policy = kPolicies[input.below(4)];
  params.max_roots = input.coin() ? 1 : 16;
  static const std::unique_ptr<Executor> threads = make_thread_pool(3);
  if (params.max_roots == 1) params.executor = threads.get();
  return params;
}

/// A hierarchy and the ids of its points.
class Run {
 public:
  Run(FuzzInput& input, const Box& box, double radius)
      : input_(input), box_(box), radius_(radius), hierarchy_(choose_params(input, radius)) {}

  void run() {
    build();
    for (int k = 0; k < kMaxOperations && !input_.empty(); ++k) {
      operate();
      require_none(hierarchy_.validate(), "validate() after operation " + std::to_string(k));
      if (input_.coin()) compare();
    }
    compare();
  }

 private:
  void build() {
    points_.clear();
    for (std::size_t k = input_.below(kMaxPoints); k > 0; --k)
      points_.push_back(choose_point(input_, box_, points_));
    hierarchy_.build(points_, box_);
    ids_.resize(points_.size());
    for (std::size_t k = 0; k < ids_.size(); ++k) ids_[k] = static_cast<std::int32_t>(k);
  }

  void operate() {
    switch (input_.below(8)) {
      case 0:
      case 1:
        if (ids_.size() < kMaxPoints) insert();
        break;
      case 2:
      case 3:
        if (!ids_.empty()) remove();
        break;
      case 4:
      case 5:
        move();
        break;
      case 6:
        renumber();
        break;
      default:
        if (input_.below(8) == 7) {
          build();
        } else {
          hierarchy_.repair();
        }
    }
  }

  void insert() {
    const Vec3 at = choose_point(input_, box_, points_);
    const std::int32_t near = ids_.empty() || input_.coin() ? -1 : ids_[input_.below(ids_.size())];
    const std::int32_t id = hierarchy_.insert(at, near);
    ids_.push_back(id);
    set_point(id, at);
  }

  void remove() {
    const std::size_t k = input_.below(ids_.size());
    hierarchy_.remove(ids_[k]);
    ids_[k] = ids_.back();
    ids_.pop_back();
  }

  void move() {
    points_.resize(hierarchy_.capacity());
    move_points(input_, radius_, points_);
    hierarchy_.update(points_, box_);
  }

  void renumber() {
    const std::size_t shift = ids_.empty() ? 0 : input_.below(ids_.size());
    std::rotate(ids_.begin(), ids_.begin() + static_cast<std::ptrdiff_t>(shift), ids_.end());
    hierarchy_.renumber(ids_);
    std::vector<Vec3> renumbered;
    for (std::int32_t& id : ids_) {
      renumbered.push_back(points_[static_cast<std::size_t>(id)]);
      id = static_cast<std::int32_t>(renumbered.size() - 1);
    }
    points_ = renumbered;
  }

  void set_point(std::int32_t id, Vec3 at) {
    const auto k = static_cast<std::size_t>(id);
    if (k >= points_.size()) points_.resize(k + 1);
    points_[k] = at;
  }

  /// The list by ids beside that of all pairs of the points that are there.
  void compare() {
    std::sort(ids_.begin(), ids_.end());
    std::vector<Vec3> live;
    for (const std::int32_t id : ids_) live.push_back(points_[static_cast<std::size_t>(id)]);
    ListParams request;
    request.cutoffs = TypeCutoffs(radius_);
    const NeighborList expected = all_pairs(live, box_, request);
    NeighborList by_id;
    by_id.first.assign(1, 0);
    std::size_t k = 0;
    for (std::size_t id = 0; id < hierarchy_.capacity(); ++id) {
      if (k < ids_.size() && static_cast<std::size_t>(ids_[k]) == id) {
        for (const std::int32_t j : expected.row(k)) by_id.j.push_back(ids_[static_cast<std::size_t>(j)]);
        ++k;
      }
      by_id.first.push_back(static_cast<std::int64_t>(by_id.j.size()));
    }
    NeighborList list;
    hierarchy_.list(request, list);
    require_none(first_difference(list, by_id), "list()");
    ask_for_nearest(Nearest(hierarchy_.view()), "view()");
    ask_for_nearest(Nearest(hierarchy_.kept_view()), "kept_view()");
  }

  /// The nearest neighbor of each point beside that of all pairs: as near, to within rounding.
  void ask_for_nearest(const Nearest& nearest, const std::string& view) {
    constexpr double kRounding = 1e-9;
    const NearestRows rows = nearest.of_points({});
    for (const std::int32_t id : ids_) {
      const auto row = static_cast<std::size_t>(id);
      double expected2 = std::numeric_limits<double>::infinity();
      for (const std::int32_t other : ids_)
        if (other != id)
          expected2 =
              std::min(expected2, box_.distance2(points_[row], points_[static_cast<std::size_t>(other)]));
      const double found2 = rows.distance2[row], slack = kRounding * (1 + radius_) * (1 + radius_);
      const bool is_same =
          found2 == expected2 || std::abs(found2 - expected2) <= kRounding * expected2 + slack;
      if (!is_same) fail("nearest neighbor of " + std::to_string(id) + " by " + view);
    }
  }

  FuzzInput& input_;
  Box box_;
  double radius_;
  ListedHierarchy hierarchy_;
  std::vector<std::int32_t> ids_;
  std::vector<Vec3> points_;  ///< by id; those of free ids mean nothing
};

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  dch::fuzz::FuzzInput input(data, size);
  const dch::Box box = dch::fuzz::choose_box(input);
  const double widest = std::min(3.0, 0.98 * box.max_cutoff());
  dch::fuzz::Run(input, box, widest * std::pow(10, -input.uniform())).run();
  return 0;
} catch (const dch::InvalidBox&) {
  return 0;  // the free vectors made no box
}

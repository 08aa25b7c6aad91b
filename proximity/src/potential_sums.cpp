// SPDX-License-Identifier: MIT
#include "potential_sums.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/aligned_vector.hpp"
#include "simd/sum_kernels.hpp"

namespace dch::detail {
namespace {

/// Targets of more points are visited before others are divided among threads.
constexpr std::int32_t kTasks = 64;

}  // namespace

/// What one thread works with.
class PotentialSums::Worker {
 public:
  Worker(PotentialSums& sums, const SumScene& scene)
      : sums_(sums),
        scene_(scene),
        kernels_(sum_kernels(instruction_set())),
        no_moments_(sums.expansions_.short_size(), 0.0),
        work_(sums.expansions_.work_size()),
        lanes_(sums.expansions_.short_size() * kSumLanes) {}

  double error() const { return error_; }
  const SumCounts& counts() const { return counts_; }

  void sum_below(SumTask task) {
    if (!take(task)) return;
    const std::int32_t children = scene_.tree.node(task.target).children;
    for (std::int32_t k = 0; k < children; ++k) sum_below(for_child(task, k));
  }

  /// Takes the sources of a target that are far, and at the bottom all. Returns whether children are left.
  bool take(SumTask& task) {
    const ChargedNode& node = scene_.tree.node(task.target);
    take_sources(scene_, task.target, task.sources, task.error, found_);
    counts_.looked_at += std::exchange(found_.looked_at, 0);
    counts_.far_pairs += static_cast<std::int64_t>(found_.far.size());
    if (!found_.far.empty()) add_far(node, task.local);
    if (node.is_bottom()) {
      sum_at_bottom(node, task);
      return false;
    }
    task.sources = found_.rest;
    return true;
  }

  SumTask for_child(const SumTask& task, std::int32_t k) const {
    const ChargedNode& node = scene_.tree.node(task.target);
    const ChargedNode& child = scene_.tree.node(node.first_child + k);
    SumTask below{node.first_child + k, task.sources, task.error,
                  std::vector<double>(sums_.expansions_.size())};
    const double inverse = node.radius > 0 ? 1 / node.radius : 0;
    sums_.expansions_.to_child(task.local.data(), inverse * (child.center - node.center),
                               inverse * child.radius, below.local.data());
    return below;
  }

 private:
  void add_far(const ChargedNode& node, std::vector<double>& local) {
    std::fill(lanes_.begin(), lanes_.end(), 0.0);
    sort_by_order();
    FarGroup group{};
    int lane = 0;
    for (std::size_t k = 0; k < sorted_.size(); ++k) {
      put(sorted_[k], node, group, lane++);
      const int order = sorted_[k].order;
      if (lane < kSumLanes && k + 1 < sorted_.size() && sorted_[k + 1].order == order) continue;
      for (; lane < kSumLanes; ++lane) {
        group.inverse[lane] = 0;
        group.moments[lane] = no_moments_.data();
      }
      kernels_.translate(sums_.tables_[static_cast<std::size_t>(order)], group, work_.data(), lanes_.data());
      lane = 0;
    }
    std::vector<double> sums(sums_.expansions_.short_size(), 0.0);
    for (std::size_t k = 0; k < lanes_.size(); ++k) sums[k / kSumLanes] += lanes_[k];
    sums_.expansions_.add_whole(sums.data(), local.data());
  }

  void sort_by_order() {
    sorted_.clear();
    for (int order = 0; order <= sums_.expansions_.order(); ++order)
      for (const FarSource& far : found_.far)
        if (far.order == order) sorted_.push_back(far);
  }

  void put(const FarSource& far, const ChargedNode& target, FarGroup& group, int lane) const {
    const ChargedNode& node = scene_.tree.node(far.source.node);
    const double inverse = 1 / far.apart;
    for (int axis = 0; axis < 3; ++axis) group.direction[axis][lane] = inverse * far.from[axis];
    group.inverse[lane] = inverse;
    group.screening[lane] = scene_.truncation.kappa() * far.apart;
    group.decay[lane] = std::exp(-group.screening[lane]);
    group.source_size[lane] = node.radius * inverse;
    group.target_size[lane] = target.radius * inverse;
    group.moments[lane] =
        sums_.moments_.data() + static_cast<std::size_t>(far.source.node) * sums_.expansions_.short_size();
  }

  void sum_at_bottom(const ChargedNode& node, SumTask& task) {
    if (task.error > 0)
      error_ = std::max(error_, task.error / scene_.least[static_cast<std::size_t>(task.target)]);
    gather_near();
    const NearCharges charges{x_.data(),
                              y_.data(),
                              z_.data(),
                              q_.data(),
                              static_cast<std::int32_t>(q_.size()),
                              scene_.tree.least2(),
                              scene_.truncation.kappa()};
    counts_.near_pairs += static_cast<std::int64_t>(node.charges) * charges.count;
    const double inverse = node.radius > 0 ? 1 / node.radius : 0;
    double potential = 0;
    for (std::int32_t k = 0; k < node.points; ++k) {
      const std::int32_t place = node.first + k;
      const Vec3 at = scene_.tree.at(place);
      if (k < node.charges)
        potential = sums_.expansions_.potential(task.local.data(), inverse * (at - node.center)) +
                    kernels_.potential(charges, at.x, at.y, at.z);
      sums_.potentials_[static_cast<std::size_t>(place)] = potential;
    }
  }

  void gather_near() {
    std::size_t count = 0;
    for (const SumSource source : found_.near)
      count += static_cast<std::size_t>(scene_.tree.node(source.node).charges);
    count = static_cast<std::size_t>(padded(static_cast<std::int32_t>(count)));
    for (auto* array : {&x_, &y_, &z_, &q_}) array->resize(count);
    std::size_t k = 0;
    for (const SumSource source : found_.near) {
      const ChargedNode& node = scene_.tree.node(source.node);
      const Vec3 image = scene_.images[static_cast<std::size_t>(source.image)];
      for (std::int32_t place = node.first; place < node.first + node.charges; ++place)
        put_charge(k++, scene_.tree.at(place) + image, scene_.tree.charge(place));
    }
    while (k < count) put_charge(k++, {}, 0);
  }
  void put_charge(std::size_t k, Vec3 at, double charge) {
    x_[k] = at.x;
    y_[k] = at.y;
    z_[k] = at.z;
    q_[k] = charge;
  }

  PotentialSums& sums_;
  const SumScene& scene_;
  const SumKernels& kernels_;
  std::vector<double> no_moments_;
  AlignedVector<double> work_, lanes_, x_, y_, z_, q_;
  Interactions found_;
  std::vector<FarSource> sorted_;
  double error_ = 0;
  SumCounts counts_;
};

PotentialSums::PotentialSums(const ChargedTree& tree, const Expansions& expansions)
    : tree_(tree),
      expansions_(expansions),
      moments_(multipoles_of(tree, expansions)),
      potentials_(static_cast<std::size_t>(tree.node(0).points), 0.0) {
  for (int order = 0; order <= expansions.order(); ++order) {
    lower_.emplace_back(order, expansions.is_harmonic());
    tables_.push_back(lower_.back().tables());
  }
}

double PotentialSums::add_up(const SumScene& scene, Executor* executor) {
  SumTask root;
  root.sources = root_sources(scene);
  root.local.assign(expansions_.size(), 0.0);
  std::vector<Worker> workers;
  workers.emplace_back(*this, scene);
  std::vector<SumTask> tasks{std::move(root)}, parts;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (tree_.node(tasks[k].target).points <= tree_.node(0).points / kTasks) {
      parts.push_back(std::move(tasks[k]));
    } else if (SumTask task = std::move(tasks[k]); workers.front().take(task)) {
      for (std::int32_t child = 0; child < tree_.node(task.target).children; ++child)
        tasks.push_back(workers.front().for_child(task, child));
    }
  }
  while (workers.size() <= parts.size()) workers.emplace_back(*this, scene);
  const auto sum_part = [&](int part) {
    workers[static_cast<std::size_t>(part) + 1].sum_below(std::move(parts[static_cast<std::size_t>(part)]));
  };
  const int count = static_cast<int>(parts.size());
  if (executor) {
    executor->run(count, sum_part);
  } else {
    for (int part = 0; part < count; ++part) sum_part(part);
  }
  double error = 0;
  counts_ = {};
  for (const Worker& worker : workers) {
    error = std::max(error, worker.error());
    counts_.far_pairs += worker.counts().far_pairs;
    counts_.near_pairs += worker.counts().near_pairs;
    counts_.looked_at += worker.counts().looked_at;
  }
  return error;
}

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#include <chrono>
#include <string>

#include <dch/error.hpp>
#include <dch/hierarchy.hpp>

#include "cost_estimate.hpp"
#include "key_table.hpp"

namespace dch {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// PairSearch on a Hierarchy. With keys, particles are matched by name: those that left are removed, new ones
/// inserted and the rest renumbered; then all are moved at once.
class DchSearch final : public PairSearch {
 public:
  explicit DchSearch(const HierarchyParams& params) : hierarchy_(params) {}

  void update(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) override {
    const auto start = Clock::now();
    try {
      if (keys.empty()) {
        by_index(positions, box);
      } else {
        by_key(positions, box, keys);
      }
    } catch (...) {
      state_ = State::empty;
      hierarchy_.build({}, Box::none());
      throw;
    }
    ++updates_;
    maintain_seconds_ += seconds_since(start);
  }

  void list(const ListParams& params, NeighborList& out) override { hierarchy_.list(params, out); }
  using PairSearch::list;

  const SearchStats& stats() const override {
    stats_ = hierarchy_.stats();
    stats_.updates = updates_;
    stats_.maintain_seconds = maintain_seconds_;
    return stats_;
  }
  std::string name() const override { return "dch"; }
  const Hierarchy& hierarchy() const { return hierarchy_; }

 private:
  enum class State { empty, indexed, keyed };

  void build(Span<const Vec3> positions, const Box& box) {
    const auto start = Clock::now();
    hierarchy_.build(positions, box);
    if (!positions.empty()) build_per_point_.observe(seconds_since(start) / double(positions.size()));
  }

  void by_index(Span<const Vec3> positions, const Box& box) {
    if (state_ == State::indexed && positions.size() == hierarchy_.size()) {
      hierarchy_.update(positions, box);
    } else {
      build(positions, box);
    }
    state_ = State::indexed;
  }

  void by_key(Span<const Vec3> positions, const Box& box, Span<const std::uint64_t> keys) {
    if (keys.size() != positions.size())
      throw InvalidParameter("update() got " + std::to_string(keys.size()) + " keys for " +
                             std::to_string(positions.size()) + " positions; give one for each, or none");
    const std::int32_t repeated = fresh_keys_.fill(keys);
    if (repeated != detail::KeyTable::kAbsent)
      throw InvalidParameter("update(): key " + std::to_string(keys[repeated]) + " of particle " +
                             std::to_string(repeated) +
                             " names an earlier particle too; keys must be distinct");
    if (state_ == State::keyed && match(positions, keys)) {
      hierarchy_.update(positions, box);
    } else {
      build(positions, box);
    }
    std::swap(keys_, fresh_keys_);
    state_ = State::keyed;
  }

  /// Makes the hierarchy hold the particles with these keys under their new indices; false if so many come
  /// and go that by the times measured so far a new build is cheaper.
  bool match(Span<const Vec3> positions, Span<const std::uint64_t> keys) {
    const std::size_t before = hierarchy_.size();
    std::vector<std::int32_t> old_of_new(keys.size());
    std::vector<char> stays(before, 0);
    std::size_t arrivals = 0;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      old_of_new[k] = keys_.find(keys[k]);
      if (old_of_new[k] == detail::KeyTable::kAbsent) {
        ++arrivals;
      } else {
        stays[old_of_new[k]] = 1;
      }
    }
    const std::size_t exchanged = arrivals + (before - (keys.size() - arrivals));
    if (hierarchy_.params().policy == MaintenancePolicy::automatic &&
        exchange_.seconds() * static_cast<double>(exchanged) >
            build_per_point_.seconds() * static_cast<double>(keys.size())) {
      exchange_.fade();
      return false;
    }

    if (exchanged > 0) hierarchy_.repair();  // what was put off is no cost of the exchange
    const auto start = Clock::now();
    for (std::size_t id = 0; id < before; ++id)
      if (!stays[id]) hierarchy_.remove(static_cast<std::int32_t>(id));
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (old_of_new[k] == detail::KeyTable::kAbsent)
        old_of_new[k] = hierarchy_.insert(positions[k], k == 0 ? -1 : old_of_new[k - 1]);
    if (exchanged > 0) exchange_.observe(seconds_since(start) / static_cast<double>(exchanged));
    hierarchy_.renumber(old_of_new);
    return true;
  }

  Hierarchy hierarchy_;
  State state_ = State::empty;
  detail::KeyTable keys_, fresh_keys_;
  detail::CostEstimate build_per_point_;
  detail::CostEstimate exchange_;  ///< to insert or remove one particle
  std::int64_t updates_ = 0;
  double maintain_seconds_ = 0;
  mutable SearchStats stats_;
};

}  // namespace

std::unique_ptr<PairSearch> make_dch_search(const HierarchyParams& params) {
  return std::make_unique<DchSearch>(params);
}

std::unique_ptr<PairSearch> make_dch_search(double radius) {
  HierarchyParams params;
  params.radius = radius;
  return make_dch_search(params);
}

const Hierarchy* hierarchy_of(const PairSearch& search) {
  const auto* engine = dynamic_cast<const DchSearch*>(&search);
  return engine ? &engine->hierarchy() : nullptr;
}

}  // namespace dch

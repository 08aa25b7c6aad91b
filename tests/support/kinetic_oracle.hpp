// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

namespace dch::kinetic {

/// All flight plans that points have had, and from them by all pairs what the edges are and when they come
/// and go. It knows no polynomials: distances change no faster than the points move, and where that leaves a
/// crossing possible a span of time is halved.
class KineticOracle {
 public:
  explicit KineticOracle(const KineticEdges& engine) : engine_(engine), start_(engine.now()) {
    for (std::int32_t id = 0; id < static_cast<std::int32_t>(engine.size()); ++id)
      plans_.push_back({engine.plan(id)});
  }

  /// To be called after set_motion().
  void note(std::int32_t id) {
    const FlightPlan &before = plans_[id].back(), after = engine_.plan(id);
    ASSERT_EQ(after.time, engine_.now());
    ASSERT_LT(engine_.box().distance2(position_at(before, after.time), after.position), 1e-18);
    plans_[id].push_back(after);
  }

  /// Events of all pairs up to now; those that undo each other within kFlicker are left out.
  std::vector<EdgeEvent> events() const {
    std::vector<EdgeEvent> all;
    for_each_pair([&](Edge edge) {
      const auto found = without_flicker(events_of(edge));
      all.insert(all.end(), found.begin(), found.end());
    });
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Pairs within their distance now by more than rounding, and those for which rounding may decide.
  void check_edges() const {
    const std::vector<Edge> edges = engine_.edges();
    for_each_pair([&](Edge edge) {
      const long double off = gap(edge, engine_.now(), last(edge.a), last(edge.b));
      if (std::abs(off) < 1e-9L) return;
      EXPECT_EQ(std::binary_search(edges.begin(), edges.end(), edge), off < 0)
          << edge.a << ", " << edge.b << " at " << engine_.now() << ", off by " << static_cast<double>(off);
    });
  }

  /// Compares what an engine said of each pair with what happened.
  void check_events(const std::vector<EdgeEvent>& said) const {
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<EdgeEvent>> of_pair;
    double last = start_;
    for (const EdgeEvent& event : said) {
      ASSERT_GE(event.time, last) << "events come in the order of time";
      last = event.time;
      of_pair[{event.edge.a, event.edge.b}].push_back(event);
    }
    for_each_pair([&](Edge edge) {
      const auto expected = without_flicker(events_of(edge)),
                 found = without_flicker(of_pair[{edge.a, edge.b}]);
      const std::string pair = std::to_string(edge.a) + ", " + std::to_string(edge.b);
      ASSERT_EQ(found.size(), expected.size()) << "pair " << pair;
      for (std::size_t k = 0; k < found.size(); ++k) {
        ASSERT_EQ(found[k].appears, expected[k].appears) << "event " << k << " of pair " << pair;
        ASSERT_NEAR(found[k].time, expected[k].time, 1e-7) << "event " << k << " of pair " << pair;
      }
    });
  }

 private:
  static constexpr double kFlicker = 1e-6;  ///< of pairs that graze their distance, rounding moves crossings
  static constexpr double kFinest = 1e-9;   ///< spans of time that are not halved any more

  template <class F>
  void for_each_pair(const F& f) const {
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(plans_.size()); ++a)
      for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(plans_.size()); ++b) f(Edge{a, b});
  }
  const FlightPlan& last(std::int32_t id) const { return plans_[id].back(); }

  static long double along(const FlightPlan& plan, int axis, long double time) {
    const long double t = time - plan.time;
    return plan.position[axis] + t * (plan.velocity[axis] + t * plan.acceleration[axis] / 2);
  }
  long double gap(Edge edge, long double time, const FlightPlan& p, const FlightPlan& q) const {
    long double d[3];
    Vec3 rounded;
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = along(q, axis, time) - along(p, axis, time);
      rounded[axis] = static_cast<double>(d[axis]);
    }
    const Vec3 shift = engine_.box().nearest_image(rounded) - rounded;
    long double sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += (d[axis] + shift[axis]) * (d[axis] + shift[axis]);
    return std::sqrt(sum) - static_cast<long double>(engine_.distance(edge));
  }

  static std::vector<EdgeEvent> without_flicker(const std::vector<EdgeEvent>& events) {
    std::vector<EdgeEvent> kept;
    for (const EdgeEvent& event : events) {
      if (!kept.empty() && event.time - kept.back().time < kFlicker) {
        kept.pop_back();
      } else {
        kept.push_back(event);
      }
    }
    return kept;
  }

  std::vector<EdgeEvent> events_of(Edge edge) const {
    std::vector<EdgeEvent> found;
    const auto &of_a = plans_[edge.a], &of_b = plans_[edge.b];
    std::size_t i = 0, j = 0;
    bool is_within = false;
    for (double from = start_; from < engine_.now();) {
      const double next_a = i + 1 < of_a.size() ? of_a[i + 1].time : kNever,
                   next_b = j + 1 < of_b.size() ? of_b[j + 1].time : kNever;
      const double to = std::min({next_a, next_b, engine_.now()});
      const auto at = [&](double time) { return gap(edge, time, of_a[i], of_b[j]); };
      const long double gap_from = at(from), gap_to = at(to);
      // Rounding may put a pair that is given a plan at its distance on the other side.
      if (from > start_ && (gap_from <= 0) != is_within) found.push_back({from, edge, gap_from <= 0});
      if (to > from) halve(edge, of_a[i], of_b[j], from, to, gap_from, gap_to, found);
      is_within = gap_to <= 0;
      if (next_a <= to) ++i;
      if (next_b <= to) ++j;
      from = to;
    }
    return found;
  }
  void halve(Edge edge, const FlightPlan& p, const FlightPlan& q, double from, double to,
             long double gap_from, long double gap_to, std::vector<EdgeEvent>& found) const {
    const double fastest = std::sqrt(std::max(norm2(velocity_at(q, from) - velocity_at(p, from)),
                                              norm2(velocity_at(q, to) - velocity_at(p, to))));
    if (std::abs(gap_from) + std::abs(gap_to) > fastest * (to - from) * (1 + 1e-9) + 1e-12) return;
    const bool changes = (gap_from <= 0) != (gap_to <= 0);
    if (to - from < kFinest) {
      if (changes) found.push_back({0.5 * (from + to), edge, gap_to <= 0});
      return;
    }
    const double middle = 0.5 * (from + to);
    const long double gap_middle = gap(edge, middle, p, q);
    halve(edge, p, q, from, middle, gap_from, gap_middle, found);
    halve(edge, p, q, middle, to, gap_middle, gap_to, found);
  }

  const KineticEdges& engine_;
  double start_;
  std::vector<std::vector<FlightPlan>> plans_;  ///< by point
};

}  // namespace dch::kinetic

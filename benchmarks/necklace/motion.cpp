// SPDX-License-Identifier: MIT
// Verification and repair of the wrapped hierarchy against building it anew, over the frames of a simulation.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <dch/base/error.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>
#include <dch/trajectory/reader.hpp>

#include "parts.hpp"
#include "stopwatch.hpp"

namespace dch::bench {

namespace {

using necklace::Necklace;
using necklace::Verification;
using necklace::WrappedHierarchy;

using Frames = std::vector<std::vector<Vec3>>;

Frames read_frames(const std::string& path, int most) {
  const auto reader = trajectory::open_trajectory(path);
  trajectory::Frame frame;
  Frames frames;
  while (static_cast<int>(frames.size()) < most && reader->read(frame)) frames.push_back(frame.positions);
  if (frames.size() < 2) throw Error(path + " has fewer than two frames; one cannot be followed");
  return frames;
}

/// Root mean square over all beads and frames, along each axis.
double step_of(const Frames& frames) {
  double sum = 0, count = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    for (std::size_t i = 0; i < frames[k].size(); ++i) sum += norm2(frames[k][i] - frames[k - 1][i]);
    count += 3 * static_cast<double>(frames[k].size());
  }
  return std::sqrt(sum / count);
}

/// Ends the program if a cage that was kept up is not the one built anew.
void require_same_cages(const WrappedHierarchy& kept, const WrappedHierarchy& built) {
  for (std::size_t k = 0; k < kept.cages().size(); ++k) {
    const double a = kept.cages()[k].radius, b = built.cages()[k].radius;
    require_same(std::abs(a - b) <= 1e-10 * b, "cages kept and built");
  }
}

/// What one way of verification took, frame by frame.
struct Course {
  std::vector<double> repair_ns, build_ns, ratios;  ///< ns for each bead
  std::vector<double> tests;                        ///< containment tests for each bead
};

/// Keeps one hierarchy up over the frames beside one that is built for each.
Course follow(const Frames& frames, WrappedHierarchy& kept, WrappedHierarchy& built) {
  kept.build(frames[0], Box::none());
  Course course;
  const auto n = static_cast<double>(frames[0].size());
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::int64_t before = kept.stats().containment_tests;
    const double repair = seconds_of([&] { kept.update(frames[k], Box::none()); });
    const double build = seconds_of([&] { built.build(frames[k], Box::none()); });
    require_same_cages(kept, built);
    course.ratios.push_back(repair / build);
    course.repair_ns.push_back(1e9 * repair / n);
    course.build_ns.push_back(1e9 * build / n);
    course.tests.push_back(static_cast<double>(kept.stats().containment_tests - before) / n);
  }
  return course;
}

const char* name_of(Verification verification) {
  switch (verification) {
    case Verification::cascade:
      return "cascade";
    case Verification::naive:
      return "naive";
    case Verification::watched:
      break;
  }
  return "watched";
}

Row measure(const Frames& frames, int leaf, Verification verification) {
  const Necklace necklace = Necklace::chain(std::vector<double>(frames[0].size(), 0.5));
  WrappedHierarchy kept(necklace, {leaf, verification}), built(necklace, {leaf, verification});
  const Course course = follow(frames, kept, built);
  const auto& stats = kept.stats();
  const char* name = name_of(verification);
  const auto updates = static_cast<double>(frames.size() - 1);
  const double tests =
      static_cast<double>(stats.containment_tests) / updates / static_cast<double>(frames[0].size());
  const double most = *std::max_element(course.tests.begin(), course.tests.end());
  const double changed = static_cast<double>(stats.basis_changes) / static_cast<double>(stats.cages_checked);
  const double repair = median_of(course.repair_ns), build = median_of(course.build_ns);
  const double ratio = median_of(course.ratios);
  fmt::print("{:>5} {:<9}{:>9.3f}{:>9.3f}{:>12.1f}{:>12.2f}%{:>11.1f}{:>11.1f}{:>9.3f}\n", leaf, name, tests,
             most, static_cast<double>(stats.escapes) / updates, 100 * changed, repair, build, ratio);
  return {{"leaf_beads", static_cast<double>(leaf)},
          {"verification", name},
          {"tests_per_bead", tests},
          {"most_tests_per_bead", most},
          {"looks_per_update", static_cast<double>(stats.looks) / updates},
          {"escapes_per_update", static_cast<double>(stats.escapes) / updates},
          {"share_of_cages_changed", changed},
          {"repair_ns_per_bead", repair},
          {"build_ns_per_bead", build},
          {"repair_to_build", ratio}};
}

}  // namespace

Table measure_motion(const std::string& trajectory, int most_frames) {
  const Frames frames = read_frames(trajectory, most_frames);
  fmt::print("{} beads, {} updates, root mean square step along each axis {:.4f}\n", frames[0].size(),
             frames.size() - 1, step_of(frames));
  fmt::print("{:>5} {:<9}{:>9}{:>9}{:>12}{:>13}{:>11}{:>11}{:>9}\n", "leaf", "verify", "tests/n", "most",
             "escapes", "changed", "repair ns", "build ns", "ratio");
  Table table;
  for (const int leaf : {1, 8}) {
    for (const auto verification : {Verification::cascade, Verification::naive, Verification::watched}) {
      table.push_back(measure(frames, leaf, verification));
    }
  }
  return table;
}

}  // namespace dch::bench

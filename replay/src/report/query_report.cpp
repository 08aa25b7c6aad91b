// SPDX-License-Identifier: MIT
#include "report/query_report.hpp"

#include <cmath>

namespace dch::cli {
namespace {

double cutoff_of(int step) { return std::pow(10, static_cast<double>(step) / ClusterCurve::kStepsPerDecade); }

/// The first step whose cutoff is at least the length, whatever the logarithm rounds to.
int step_of(double length) {
  int step = static_cast<int>(std::ceil(ClusterCurve::kStepsPerDecade * std::log10(length)));
  while (cutoff_of(step) < length) ++step;
  while (cutoff_of(step - 1) >= length) --step;
  return step;
}

}  // namespace

void ClusterCurve::add(const SpanningTree& tree) {
  ++frames_;
  atoms_ += static_cast<std::int64_t>(tree.points.size());
  for (const TreeEdge& edge : tree.edges) {
    ++(edge.distance2 > 0 ? edges_[step_of(std::sqrt(edge.distance2))] : coincident_);
  }
}

std::vector<ClusterCurve::Point> ClusterCurve::points() const {
  std::vector<Point> points;
  if (edges_.empty()) return points;
  std::int64_t clusters = atoms_ - coincident_;
  // One more in front, so that the curve begins with all atoms on their own
  for (int step = edges_.begin()->first - 1; step <= edges_.rbegin()->first; ++step) {
    if (const auto found = edges_.find(step); found != edges_.end()) clusters -= found->second;
    points.push_back({cutoff_of(step), static_cast<double>(clusters) / static_cast<double>(frames_)});
  }
  return points;
}

const QueryFrame* QueryReport::closest() const {
  const QueryFrame* found = nullptr;
  for (const QueryFrame& frame : frames) {
    if (frame.closest && (!found || frame.closest->distance < found->closest->distance)) found = &frame;
  }
  return found;
}

}  // namespace dch::cli

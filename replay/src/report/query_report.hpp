// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <dch/proximity/spanning_tree.hpp>

#include "input/trajectory_summary.hpp"

namespace dch::cli {

/// Two atoms by their ids in the file, the smaller one first.
struct AtomPair {
  std::int64_t i = -1, j = -1;
  double distance = 0;  ///< of nearest images [length]
};

/// What was found in one frame. Times in milliseconds of wall clock.
struct QueryFrame {
  std::int64_t frame = 0;  ///< index in the file, from 0
  std::int64_t step = 0;
  std::int64_t atoms = 0;
  std::optional<double> time;                   ///< in the file's unit
  std::optional<AtomPair> closest;              ///< none of fewer than two atoms
  std::vector<std::int64_t> clusters, largest;  ///< by cutoff: how many, and atoms of the largest one
  double read_ms = 0, update_ms = 0, nearest_ms = 0, clusters_ms = 0;
};

/// Least, mean and most of some lengths.
class LengthSpread {
 public:
  void add(double length) {
    least_ = count_ == 0 || length < least_ ? length : least_;
    most_ = count_ == 0 || length > most_ ? length : most_;
    sum_ += length;
    ++count_;
  }
  std::int64_t count() const { return count_; }
  double least() const { return least_; }
  double most() const { return most_; }
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }

 private:
  std::int64_t count_ = 0;
  double least_ = 0, most_ = 0, sum_ = 0;
};

/// How many clusters there are at every cutoff, as a mean over the frames: the edges of their spanning trees,
/// counted by length.
class ClusterCurve {
 public:
  struct Point {
    double cutoff = 0;    ///< [length]
    double clusters = 0;  ///< of a frame
  };

  void add(const SpanningTree& tree);
  /// From the shortest edge to the longest, kStepsPerDecade cutoffs a decade; empty without an edge.
  std::vector<Point> points() const;

  static constexpr int kStepsPerDecade = 20;

 private:
  std::int64_t frames_ = 0, atoms_ = 0;
  std::map<int, std::int64_t> edges_;  ///< by step: those up to its cutoff that are beyond the one before
  std::int64_t coincident_ = 0;        ///< edges without a length
};

/// All that `dchmd query` found; its table, JSON and page show nothing else.
struct QueryReport : TrajectorySummary {
  std::vector<double> cutoffs;  ///< of clusters, as asked for; empty: none were [length]
  std::vector<QueryFrame> frames;
  std::vector<LengthSpread> nearest;  ///< [j]: distances of the (j+1)-th nearest atom, over atoms and frames
  std::vector<std::map<std::int64_t, std::int64_t>> sizes;  ///< by cutoff: clusters of each size, over frames
  ClusterCurve curve;
  double radius = 0;  ///< that the hierarchy was made for [length]
  int threads = 1;
  double scan_ms = 0, write_ms = 0, total_ms = 0;

  /// Of the frames' closest pairs, the closest, and the first of those; none without a pair.
  const QueryFrame* closest() const;
};

/// report.json of queries, as docs/report-schema.md describes it.
std::string render_json(const QueryReport& report);
/// One page that needs nothing from outside.
std::string render_html(const QueryReport& report);
/// The table at the end of a run.
std::string render_table(const QueryReport& report);

}  // namespace dch::cli

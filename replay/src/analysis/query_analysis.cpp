// SPDX-License-Identifier: MIT
#include "analysis/query_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include <dch/hierarchy/hierarchy.hpp>
#include <dch/proximity/nearest.hpp>
#include <dch/trajectory/file_error.hpp>

#include "analysis/frame_errors.hpp"
#include "base/interrupt.hpp"
#include "base/stopwatch.hpp"
#include "engines/neighbor_distance.hpp"
#include "input/frame_stream.hpp"
#include "report/query_file.hpp"

namespace dch::cli {
namespace {

/// One run: what is found out beforehand, and the state that goes through the frames.
class QueryAnalysis {
 public:
  QueryAnalysis(const QueryOptions& options, ProgressBar& progress) : options_(options), progress_(progress) {
    report_.cutoffs = options.cutoffs;
    report_.sizes.resize(options.cutoffs.size());
    report_.nearest.resize(static_cast<std::size_t>(options.k));
    report_.threads = options.threads;
  }
  QueryReport run();

 private:
  void scan();
  void follow_frames();
  void look_at(const trajectory::Frame& frame, std::int64_t index, double read_ms);
  void update(const trajectory::Frame& frame, std::int64_t index);
  void find_nearest(const HierarchyView& view, QueryFrame& record);
  void find_clusters(const HierarchyView& view, QueryFrame& record);

  const QueryOptions& options_;
  ProgressBar& progress_;
  Stopwatch watch_;
  QueryReport report_;
  std::int64_t frames_expected_ = 0;
  std::unique_ptr<Executor> threads_;
  std::optional<Hierarchy> hierarchy_;
  std::vector<std::int64_t> ids_;  ///< of the atoms that hierarchy_ holds
  NearestRows rows_;
  SpanningTree tree_;
  std::vector<ClusterLabels> labels_;  ///< by cutoff
  std::optional<QueryFile> data_;
};

QueryReport QueryAnalysis::run() {
  scan();
  follow_frames();
  if (data_) data_->commit();
  report_.total_ms = watch_.milliseconds();
  return std::move(report_);
}

void QueryAnalysis::scan() {
  const Stopwatch watch;
  const Scan scan = scan_trajectory(options_.input, options_.frames, progress_);
  report_.scan_ms = watch.milliseconds();
  static_cast<TrajectorySummary&>(report_) = scan;
  frames_expected_ = scan.frames;
  const double distance = neighbor_distance(scan.first_frame.positions, scan.first_frame.box, options_.k);
  // Coincident atoms and single ones leave the radius open; no frame's box may be too small for it
  const double wanted = distance > 0 ? distance : 1;
  report_.radius = std::clamp(std::min(wanted, scan.smallest_height / 2), kMinListRadius, kMaxListRadius);
  if (options_.data.empty()) return;
  QueryFileHeader header;
  header.source = options_.input.name();
  header.unit = report_.unit;
  header.k = options_.k;
  header.cutoffs = options_.cutoffs;
  data_.emplace(options_.data, header);
}

void QueryAnalysis::follow_frames() {
  FrameStream stream(options_.input, options_.frames);
  threads_ = make_threads(options_.threads);  // after the child processes, which would inherit their locks
  HierarchyParams params;
  params.radius = report_.radius;
  params.executor = threads_.get();
  hierarchy_.emplace(params);
  progress_.start("asking", frames_expected_);
  trajectory::Frame frame;
  for (std::int64_t done = 0; done < frames_expected_; ++done) {
    const Stopwatch watch;
    if (!stream.next(frame)) fail_changed(options_.input.name());
    look_at(frame, stream.index(), watch.milliseconds());
    progress_.advance(done + 1);
  }
  progress_.clear();
}

void QueryAnalysis::look_at(const trajectory::Frame& frame, std::int64_t index, double read_ms) {
  QueryFrame record;
  record.frame = index;
  record.step = frame.step;
  record.time = frame.time;
  record.atoms = static_cast<std::int64_t>(frame.ids.size());
  record.read_ms = read_ms;
  const Stopwatch watch;
  update(frame, index);
  const HierarchyView view = hierarchy_->view();
  record.update_ms = watch.milliseconds();
  find_nearest(view, record);
  if (!options_.cutoffs.empty()) find_clusters(view, record);
  if (data_) {
    const Stopwatch write;
    data_->append(record, ids_, rows_);
    if (!options_.cutoffs.empty()) data_->append(ids_, tree_, labels_);
    report_.write_ms += write.milliseconds();
  }
  report_.frames.push_back(std::move(record));
}

/// Other atoms than before are other points: these are built anew.
void QueryAnalysis::update(const trajectory::Frame& frame, std::int64_t index) {
  in_frame(options_.input.name(), index, [&] {
    if (!report_.frames.empty() && frame.ids == ids_) {
      hierarchy_->update(frame.positions, frame.box);
    } else {
      hierarchy_->build(frame.positions, frame.box);
      ids_ = frame.ids;
    }
  });
}

void QueryAnalysis::find_nearest(const HierarchyView& view, QueryFrame& record) {
  const Stopwatch watch;
  NearestParams params;
  params.k = options_.k;
  params.executor = threads_.get();
  Nearest(view).of_points(params, rows_);
  record.nearest_ms = watch.milliseconds();
  const auto width = static_cast<std::size_t>(options_.k);
  for (std::size_t entry = 0; entry < rows_.id.size(); ++entry) {
    if (rows_.id[entry] < 0) continue;
    const double distance = std::sqrt(rows_.distance2[entry]);
    report_.nearest[entry % width].add(distance);
    if (entry % width != 0) continue;
    const auto [i, j] = std::minmax(ids_[entry / width], ids_[static_cast<std::size_t>(rows_.id[entry])]);
    const AtomPair pair{i, j, distance};
    const auto rank = [](const AtomPair& p) { return std::make_tuple(p.distance, p.i, p.j); };
    if (!record.closest || rank(pair) < rank(*record.closest)) record.closest = pair;
  }
}

void QueryAnalysis::find_clusters(const HierarchyView& view, QueryFrame& record) {
  const Stopwatch watch;
  tree_ = minimum_spanning_tree(view, threads_.get());
  report_.curve.add(tree_);
  labels_.clear();
  for (std::size_t k = 0; k < options_.cutoffs.size(); ++k) {
    const Clusters clusters = clusters_at(tree_, options_.cutoffs[k]);
    for (const std::int64_t size : clusters.sizes) ++report_.sizes[k][size];
    record.clusters.push_back(static_cast<std::int64_t>(clusters.sizes.size()));
    record.largest.push_back(clusters.sizes.empty() ? 0 : clusters.sizes.front());
    // Numbers of points become ids of the file, whose order may be another one
    std::vector<std::int64_t> smallest(ids_.size(), std::numeric_limits<std::int64_t>::max());
    for (std::size_t atom = 0; atom < ids_.size(); ++atom) {
      std::int64_t& id = smallest[static_cast<std::size_t>(clusters.label[atom])];
      id = std::min(id, ids_[atom]);
    }
    ClusterLabels& label = labels_.emplace_back();
    for (const std::int32_t point : clusters.label)
      label.push_back(smallest[static_cast<std::size_t>(point)]);
  }
  record.clusters_ms = watch.milliseconds();
}

}  // namespace

QueryReport analyze_proximity(const QueryOptions& options, ProgressBar& progress) {
  return QueryAnalysis(options, progress).run();
}

}  // namespace dch::cli

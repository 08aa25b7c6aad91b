// SPDX-License-Identifier: MIT
#include "report/query_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/version.hpp"

namespace dch::cli {
namespace {

constexpr std::int64_t kQueryChunk = 1024;

std::int64_t rows_a_chunk(std::int64_t columns) {
  return std::max<std::int64_t>(1, kChunkEntries / std::max<std::int64_t>(1, columns));
}

}  // namespace

QueryFile::QueryFile(const std::string& path, const QueryFileHeader& header) : file_(path) {
  file_.write_attribute("format", std::string("dch proximity 1"));
  file_.write_attribute("creator", fmt::format("dchmd {}", kVersion));
  file_.write_attribute("source", header.source);
  file_.write_attribute("unit", header.unit);
  file_.create_group("frames");
  for (const char* name : {"frame", "step", "first", "closest_i", "closest_j"}) {
    file_.create_dataset(fmt::format("frames/{}", name), Hdf5Type::int64, 0, kQueryChunk);
  }
  for (const char* name : {"time", "closest_distance"}) {
    file_.create_dataset(fmt::format("frames/{}", name), Hdf5Type::float64, 0, kQueryChunk);
  }
  file_.create_group("atoms");
  file_.create_dataset("atoms/id", Hdf5Type::int64, 0, kChunkEntries);
  file_.create_dataset("atoms/nearest", Hdf5Type::int64, header.k, rows_a_chunk(header.k));
  file_.create_dataset("atoms/distance", Hdf5Type::float64, header.k, rows_a_chunk(header.k));
  if (header.cutoffs.empty()) return;
  const auto columns = static_cast<std::int64_t>(header.cutoffs.size());
  file_.create_dataset("atoms/cluster", Hdf5Type::int64, columns, rows_a_chunk(columns));
  file_.create_dataset("frames/first_edge", Hdf5Type::int64, 0, kQueryChunk);
  file_.create_group("tree");
  for (const char* name : {"i", "j"}) {
    file_.create_dataset(fmt::format("tree/{}", name), Hdf5Type::int64, 0, kChunkEntries);
  }
  file_.create_dataset("tree/distance", Hdf5Type::float64, 0, kChunkEntries);
  file_.create_dataset("cutoffs", Hdf5Type::float64, 0, columns);
  file_.append("cutoffs", 0, header.cutoffs);
}

void QueryFile::append(const QueryFrame& frame, const std::vector<std::int64_t>& ids,
                       const NearestRows& rows) {
  const auto write = [&](const char* name, std::int64_t value) {
    file_.append(fmt::format("frames/{}", name), 0, std::vector<std::int64_t>{value});
  };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  write("frame", frame.frame);
  write("step", frame.step);
  write("first", atoms_);
  write("closest_i", frame.closest ? frame.closest->i : -1);
  write("closest_j", frame.closest ? frame.closest->j : -1);
  file_.append("frames/time", 0, std::vector<double>{frame.time.value_or(kNone)});
  file_.append("frames/closest_distance", 0,
               std::vector<double>{frame.closest ? frame.closest->distance : kNone});
  atoms_ += static_cast<std::int64_t>(ids.size());
  if (ids.empty()) return;
  std::vector<std::int64_t> nearest;
  std::vector<double> distance;
  for (const std::int32_t id : rows.id) nearest.push_back(id < 0 ? -1 : ids[static_cast<std::size_t>(id)]);
  for (const double distance2 : rows.distance2) distance.push_back(std::sqrt(distance2));
  file_.append("atoms/id", 0, ids);
  file_.append("atoms/nearest", rows.k, nearest);
  file_.append("atoms/distance", rows.k, distance);
}

void QueryFile::append(const std::vector<std::int64_t>& ids, const SpanningTree& tree,
                       const std::vector<ClusterLabels>& labels) {
  file_.append("frames/first_edge", 0, std::vector<std::int64_t>{edges_});
  edges_ += static_cast<std::int64_t>(tree.edges.size());
  std::vector<std::int64_t> cluster;
  for (std::size_t atom = 0; atom < ids.size(); ++atom) {
    for (const ClusterLabels& label : labels) cluster.push_back(label[atom]);
  }
  if (!cluster.empty()) file_.append("atoms/cluster", static_cast<std::int64_t>(labels.size()), cluster);
  if (tree.edges.empty()) return;
  std::vector<std::int64_t> i, j;
  std::vector<double> distance;
  for (const TreeEdge& edge : tree.edges) {
    const auto [a, b] =
        std::minmax(ids[static_cast<std::size_t>(edge.a)], ids[static_cast<std::size_t>(edge.b)]);
    i.push_back(a);
    j.push_back(b);
    distance.push_back(std::sqrt(edge.distance2));
  }
  file_.append("tree/i", 0, i);
  file_.append("tree/j", 0, j);
  file_.append("tree/distance", 0, distance);
}

}  // namespace dch::cli

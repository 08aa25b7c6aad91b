// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/proximity/nearest.hpp>
#include <dch/proximity/spanning_tree.hpp>

#include "report/hdf5_file.hpp"
#include "report/query_report.hpp"

namespace dch::cli {

/// What a file of queries says about itself.
struct QueryFileHeader {
  std::string source;  ///< the trajectory's name
  std::string unit;    ///< of lengths
  std::int32_t k = 1;  ///< nearest atoms of each
  std::vector<double> cutoffs;
};

/// Clusters at one cutoff: for each atom the smallest id of its cluster.
using ClusterLabels = std::vector<std::int64_t>;

/// Writes nearest atoms, spanning trees and clusters to an HDF5 file, frame by frame. docs/formats.md
/// describes the file. All functions throw trajectory::FileError, the disk being full, say.
class QueryFile {
 public:
  QueryFile(const std::string& path, const QueryFileHeader& header);

  /// @param ids of the frame's atoms, which rows, tree and labels number from 0
  void append(const QueryFrame& frame, const std::vector<std::int64_t>& ids, const NearestRows& rows);
  /// @param labels by cutoff
  void append(const std::vector<std::int64_t>& ids, const SpanningTree& tree,
              const std::vector<ClusterLabels>& labels);
  /// Completes the file and gives it its name.
  void commit() { file_.commit(); }

 private:
  Hdf5File file_;
  std::int64_t atoms_ = 0;  ///< of all frames so far
  std::int64_t edges_ = 0;
};

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/lists/neighbor_list.hpp>
#include <dch/trajectory/frame.hpp>

#include "report/between_report.hpp"
#include "report/hdf5_file.hpp"

namespace dch::cli {

/// What a file of lists says about itself.
struct ListFileHeader {
  std::string source;  ///< the trajectory's file name
  std::string unit;    ///< of cutoff and skin
  std::string engine;
  std::string exclusions;       ///< "none", "1-2", "1-3", "1-4"
  double cutoff = 0, skin = 0;  ///< [length]
  ListKind kind = ListKind::half;
  std::size_t most_atoms = 0;  ///< in a frame
  bool continuous = false;     ///< contacts between frames are written, too
};

/// Writes neighbor lists to an HDF5 file, frame by frame: only the frame at hand is held in memory.
///
/// Dataset `j` holds the neighbors of all frames one after the other; row k of `first` (frames x most atoms +
/// 1) holds where the rows of frame k begin in it: the neighbors of atom i in frame k are j[first[k, i] :
/// first[k, i + 1]], and ids[k, i] is the atom's id. A frame with fewer atoms ends in empty rows of id -1. A
/// frame whose list was kept from the frame before points to the same entries. docs/cli.md describes the
/// file.
class ListFile {
 public:
  /// @throws trajectory::FileError if the file cannot be created.
  ListFile(const std::string& path, const ListFileHeader& header);

  /// @param index number of the frame in the file
  /// @param is_new false if `list` is the list of the frame before
  /// @throws trajectory::FileError, the disk being full, say.
  void append(std::int64_t index, const trajectory::Frame& frame, const NeighborList& list, bool is_new);

  /// What is between two frames. @throws trajectory::FileError, the disk being full, say.
  void append(const IntervalRecord& interval, const std::vector<BetweenContact>& contacts);

  /// Completes the file and gives it its name. @throws trajectory::FileError.
  void commit();

 private:
  Hdf5File file_;
  std::size_t most_atoms_;
  std::vector<std::int64_t> first_;  ///< of the frame last written
  std::int64_t entries_ = 0;         ///< in dataset j
  std::int64_t intervals_ = 0;
};

}  // namespace dch::cli

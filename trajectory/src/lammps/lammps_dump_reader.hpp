// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include <dch/trajectory/reader.hpp>

#include "files/line_reader.hpp"
#include "frames/frame_sorter.hpp"
#include "lammps/dump_header.hpp"

namespace dch::trajectory {

/// LAMMPS text dumps of style atom and custom, plain or gzip-compressed.
///
/// Atoms may come and go from frame to frame if there are ids to tell them apart, as LAMMPS lets them
/// (deposition, evaporation, a dump of a dynamic group).
class LammpsDumpReader final : public TrajectoryReader {
 public:
  /// @throws FileError as open_trajectory.
  LammpsDumpReader(const std::string& path, const ReadLimits& limits);

  bool read(Frame& frame) override;
  std::string format() const override { return "LAMMPS dump"; }
  std::string length_unit() const override;

 private:
  void read_atoms(Frame& frame);
  void read_atom(std::string_view line, Frame& frame);
  template <class T>
  void read_field(std::string_view word, const char* what, T& value) const;
  Vec3 unscaled(Vec3 p) const;
  void sort_by_id(Frame& frame);
  void check_same_atoms();

  LineReader lines_;
  DumpHeaderReader header_reader_;
  DumpHeader header_;
  std::int64_t frames_ = 0;
  std::int64_t first_atom_line_ = 0;
  bool first_has_id_ = false;  ///< whether the first frame has a column of ids
  std::int64_t first_atoms_ = 0;
  FrameSorter sorter_;
};

}  // namespace dch::trajectory

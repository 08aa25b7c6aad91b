// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <dch/trajectory/reader.hpp>

#include "files/line_reader.hpp"

namespace dch::trajectory {

/// GROMACS GRO: a title, the number of atoms, one line of fixed columns an atom, the box (GROMACS reference
/// manual, "gro format"). A file may hold several frames, of the same atoms.
class GroReader final : public TrajectoryReader {
 public:
  /// @throws FileError as open_trajectory.
  GroReader(const std::string& path, const ReadLimits& limits)
      : lines_(path, FinalNewline::required, limits) {}

  bool read(Frame& frame) override;
  std::string format() const override { return "GROMACS GRO"; }
  std::string length_unit() const override { return "nm"; }

 private:
  bool find_title(std::string_view& title);
  void read_title(std::string_view title, Frame& frame) const;
  std::string_view line_of(const char* what);
  std::int64_t read_count();
  void read_atoms(std::int64_t atoms, Frame& frame);
  Vec3 read_atom(std::string_view line) const;
  std::size_t find_width(std::string_view line) const;
  Box read_box();

  LineReader lines_;
  std::int64_t frames_ = 0;
  std::int64_t atoms_ = 0;       ///< of the first frame
  std::int64_t title_line_ = 0;  ///< of the frame at hand
  std::size_t width_ = 0;        ///< of a coordinate of the frame at hand [columns]
};

}  // namespace dch::trajectory

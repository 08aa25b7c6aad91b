// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include <dch/trajectory/output_file.hpp>
#include <dch/trajectory/writer.hpp>

#include "lammps/lammps_units.hpp"

namespace dch::trajectory {

/// LAMMPS text dumps. Numbers have as many digits as it takes to read them back exactly.
///
/// A frame without a box gets one of zeros, which the reader takes for none.
class LammpsDumpWriter final : public TrajectoryWriter {
 public:
  /// @throws FileError as create_trajectory.
  LammpsDumpWriter(const std::string& path, const std::string& length_unit);

  void write(const Frame& frame) override;
  void close() override;

 private:
  void append_header(const Frame& frame);
  void append_box(const Box& box);
  void append_atoms(const Frame& frame);
  void flush();

  OutputFile file_;
  bool closed_ = false;
  const LammpsUnits* units_;  ///< null if the unit of length is none of LAMMPS's
  fmt::memory_buffer text_;
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>

#include <dch/trajectory/writer.hpp>

#include "lammps_units.hpp"
#include "temporary_file.hpp"

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
  const std::string& temporary_path() const override { return file_.path(); }

 private:
  void append_header(const Frame& frame);
  void append_box(const Box& box);
  void append_atoms(const Frame& frame);
  void flush();

  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  TemporaryFile file_;
  std::unique_ptr<std::FILE, CloseFile> stream_;
  const LammpsUnits* units_;  ///< null if the unit of length is none of LAMMPS's
  fmt::memory_buffer text_;
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory

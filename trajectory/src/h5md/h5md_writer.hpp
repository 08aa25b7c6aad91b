// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <dch/trajectory/output_file.hpp>
#include <dch/trajectory/writer.hpp>

#include "process/child_process.hpp"

namespace dch::trajectory {

/// Writes an H5mdFile in a child process, so that nothing that befalls HDF5 there befalls the host.
class H5mdWriter final : public TrajectoryWriter {
 public:
  /// @throws FileError as create_trajectory.
  H5mdWriter(const std::string& path, const std::string& length_unit);

  void write(const Frame& frame) override;
  void close() override;

 private:
  void start(const std::string& length_unit);
  void await_answer(bool was_sent);

  OutputFile target_;
  std::unique_ptr<ChildProcess> child_;
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/sphere_start.hpp"
#include "base/progress_bar.hpp"
#include "report/sphere_report.hpp"

namespace dch::cli {

struct SphereOptions {
  std::string from;  ///< restart file; empty: `start` says
  StartOptions start;
  std::optional<double> jam;  ///< pressure, over that of an ideal gas, up to which the spheres are to grow
  double restitution = 1;
  double time = 0;              ///< how long to run after that
  std::int64_t collisions = 0;  ///< or how many collisions, if the time is 0
  double every = 0;             ///< time between two frames
  std::string frames, restart;  ///< files to write; empty: none
};

/// @throws UsageError, trajectory::FileError, and what the library throws for parameters out of range.
SphereReport run_hard_spheres(const SphereOptions& options, ProgressBar& progress);

}  // namespace dch::cli

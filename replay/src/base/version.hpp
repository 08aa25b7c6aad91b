// SPDX-License-Identifier: MIT
#pragma once

namespace dch::cli {

/// Version of the project, as CMake knows it.
inline constexpr const char* kVersion = DCH_VERSION;

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace dch::trajectory {

/// Throws FileError "path: what".
[[noreturn]] void fail(const std::string& path, const std::string& what);

/// Throws FileError "path: frame F, line L: what" (frames from 0, lines from 1).
[[noreturn]] void fail_at_line(const std::string& path, std::int64_t frame, std::int64_t line,
                               const std::string& what);

/// Throws FileError "path: line L: what", for files without frames.
[[noreturn]] void fail_at_line(const std::string& path, std::int64_t line, const std::string& what);

/// Throws FileError "path: frame F, byte B: what" (both from 0).
[[noreturn]] void fail_at_byte(const std::string& path, std::int64_t frame, std::int64_t offset,
                               const std::string& what);

}  // namespace dch::trajectory

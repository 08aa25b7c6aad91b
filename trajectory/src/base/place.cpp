// SPDX-License-Identifier: MIT
#include "base/place.hpp"

#include <fmt/format.h>

#include <dch/trajectory/file_error.hpp>

namespace dch::trajectory {

void fail(const std::string& path, const std::string& what) {
  throw FileError(fmt::format("{}: {}", path, what));
}

void fail_at_line(const std::string& path, std::int64_t frame, std::int64_t line, const std::string& what) {
  throw FileError(fmt::format("{}: frame {}, line {}: {}", path, frame, line, what));
}

void fail_at_line(const std::string& path, std::int64_t line, const std::string& what) {
  throw FileError(fmt::format("{}: line {}: {}", path, line, what));
}

void fail_at_byte(const std::string& path, std::int64_t frame, std::int64_t offset, const std::string& what) {
  throw FileError(fmt::format("{}: frame {}, byte {}: {}", path, frame, offset, what));
}

}  // namespace dch::trajectory

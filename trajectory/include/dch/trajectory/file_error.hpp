// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/base/error.hpp>

namespace dch::trajectory {

/// A file that cannot be read, is broken, or cannot be written. The message names the file, the frame (from
/// 0) and the line or byte offset where they are known, what was found and what was expected.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace dch::trajectory

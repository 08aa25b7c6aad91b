// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/reader.hpp>

namespace dch::trajectory::test {

/// All frames of a file. @throws FileError.
inline std::vector<Frame> read_all(TrajectoryReader& reader) {
  std::vector<Frame> frames;
  for (Frame frame; reader.read(frame);) frames.push_back(frame);
  return frames;
}
inline std::vector<Frame> read_all(const std::string& path) { return read_all(*open_trajectory(path)); }

/// What happens when a file is read to its end.
struct Outcome {
  std::size_t frames = 0;  ///< read before the end or the error
  std::string error;       ///< empty if there was none
};

inline Outcome try_to_read(const std::string& path) {
  Outcome outcome;
  try {
    const auto reader = open_trajectory(path);
    for (Frame frame; reader->read(frame);) ++outcome.frames;
  } catch (const FileError& error) {
    outcome.error = error.what();
  }
  return outcome;
}

}  // namespace dch::trajectory::test

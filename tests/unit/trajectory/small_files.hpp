// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scratch_folder.hpp"

namespace dch::trajectory::test {

/// A small file of one format.
struct SmallFile {
  std::string name;
  std::string bytes;
  /// Offsets where whole frames end: a file cut at the k-th is a file of k + 1 frames.
  std::vector<std::size_t> frame_ends;
  bool frames_come_last = true;  ///< nothing that a cut could damage lies behind the last frame
};

/// One of every format that can be read, of two or three frames.
std::vector<SmallFile> small_files(const ScratchFolder& folder);

}  // namespace dch::trajectory::test

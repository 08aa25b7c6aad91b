// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/line_reader.hpp"

namespace dch::trajectory {

/// From the ids that a topology file names to indices into a frame's arrays.
class AtomIndex {
 public:
  /// @param ids the frame's ids, ascending; must outlive this object
  explicit AtomIndex(const std::vector<std::int64_t>& ids) : ids_(ids) {}

  std::size_t size() const { return ids_.size(); }

  /// Index of the atom that a word names. @throws FileError for the reader's line if it is no id, or not one
  /// of the frame.
  std::int32_t parse(const LineReader& lines, std::string_view word) const;
  /// Likewise of an id.
  std::int32_t find(const LineReader& lines, std::int64_t id) const;

 private:
  const std::vector<std::int64_t>& ids_;
};

}  // namespace dch::trajectory

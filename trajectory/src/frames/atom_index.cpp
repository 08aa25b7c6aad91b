// SPDX-License-Identifier: MIT
#include "frames/atom_index.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/text.hpp"

namespace dch::trajectory {

std::int32_t AtomIndex::parse(const LineReader& lines, std::string_view word) const {
  std::int64_t id = 0;
  if (!parse_number(word, id)) lines.fail_here("expected the id of an atom, found " + in_quotes(word));
  return find(lines, id);
}

std::int32_t AtomIndex::find(const LineReader& lines, std::int64_t id) const {
  const auto found = std::lower_bound(ids_.begin(), ids_.end(), id);
  if (found != ids_.end() && *found == id) return static_cast<std::int32_t>(found - ids_.begin());
  if (ids_.empty())
    lines.fail_here(fmt::format("the trajectory has no atom with the id {}: it has no atoms", id));
  lines.fail_here(
      fmt::format("the trajectory has no atom with the id {} (it has {} atoms with ids from {} to {})", id,
                  ids_.size(), ids_.front(), ids_.back()));
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "input/bead_radii.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include <dch/geometry/box.hpp>

#include "base/exit_code.hpp"
#include "options/option_values.hpp"

namespace dch::cli {
namespace {

double parse_radius(const std::string& text) {
  return parse_number("--radius", text,
                      {0, kMaxCoordinate, false,
                       "the radius of the beads, a length in the file's unit, or one for each type as in "
                       "1=0.5,2=0.7"});
}

}  // namespace

BeadRadii::BeadRadii(const std::string& text) {
  if (text.find('=') == std::string::npos) {
    all_ = parse_radius(text);
    return;
  }
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t equals = std::min(part.find('='), part.size());
    constexpr std::int64_t kMaxType = std::numeric_limits<std::int32_t>::max();
    const auto type = static_cast<std::int32_t>(
        parse_whole_number("--radius", part.substr(0, equals), -kMaxType, kMaxType,
                           "a type of atom and the radius of its beads, as in 1=0.5,2=0.7"));
    const double radius = parse_radius(part.substr(std::min(equals + 1, part.size())));
    if (!by_type_.emplace(type, radius).second) {
      throw UsageError(fmt::format("--radius {}: names the type {} twice; give each type once", text, type));
    }
    begin = end + 1;
  }
}

std::vector<double> BeadRadii::of(const BeadChains& beads, const std::string& file) const {
  std::vector<double> radii(beads.ids.size(), all_);
  if (by_type_.empty()) return radii;
  if (beads.types.empty()) {
    throw UsageError(
        fmt::format("--radius goes by type, but {} has no types; give one radius for all", file));
  }
  for (std::size_t bead = 0; bead < radii.size(); ++bead) {
    const auto found = by_type_.find(beads.types[bead]);
    if (found == by_type_.end()) {
      throw UsageError(
          fmt::format("--radius has none for the type {}, which the bead with the id {} is of; add "
                      "{}=R",
                      beads.types[bead], beads.ids[bead], beads.types[bead]));
    }
    radii[bead] = found->second;
  }
  return radii;
}

}  // namespace dch::cli

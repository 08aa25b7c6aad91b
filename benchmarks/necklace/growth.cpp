// SPDX-License-Identifier: MIT
// Growth of the visited pairs (Theorem 4.5.1).
#include <cmath>
#include <fmt/format.h>

#include <dch/necklace/contacts.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "parts.hpp"

namespace dch::bench {

namespace {

using necklace::Shape;

struct Family {
  const char* name;
  double radius;
  double exponent;   ///< of n in the law that visited pairs are divided by
  bool logarithmic;  ///< whether it has a factor lg n
  bool apart;        ///< whether it has no contact
  Shape (*shape)(std::int32_t beads);
};

Shape line(std::int32_t n) { return necklace::grid_necklace(n, 1, 1); }
Shape square(std::int32_t n) {
  const auto side = static_cast<std::int32_t>(std::lround(std::sqrt(n)));
  return necklace::grid_necklace(side, side, 1);
}
Shape cube(std::int32_t n) {
  const auto side = static_cast<std::int32_t>(std::lround(std::cbrt(n)));
  return necklace::grid_necklace(side, side, side);
}
Shape coil(std::int32_t n) { return necklace::helix(n, 3.2, 0.3, 0.06); }
Shape swollen(std::int32_t n) { return necklace::self_avoiding_walk(n, 1, 1); }
Shape walk(std::int32_t n) { return necklace::random_walk(n, 1); }
Shape packed(std::int32_t n) { return necklace::globule(n, 0.1, 1); }

constexpr Family kFamilies[] = {
    {"line", 0.49, 1, false, true, line},
    {"grid 2D", 0.49, 1, true, true, square},
    {"grid 3D", 0.49, 4.0 / 3, false, true, cube},
    {"helix", 0.49, 1, false, false, coil},
    {"self-avoiding walk", 0.49, 1, false, true, swollen},
    {"random walk", 0.49, 1, false, false, walk},
    {"globule", 0.38, 4.0 / 3, false, true, packed},
};

necklace::WrappedHierarchy wrapped_of(const Shape& shape, double radius) {
  necklace::WrappedHierarchy hierarchy(necklace_of(shape, radius), {1, necklace::Verification::cascade});
  hierarchy.build(shape.positions, Box::none());
  return hierarchy;
}

Row measure(const Family& family, std::int32_t n) {
  const Shape shape = family.shape(n);
  const double beads = static_cast<double>(shape.positions.size());
  necklace::ContactStats stats;
  const auto hierarchy = wrapped_of(shape, family.radius);
  necklace::ContactQuery query;
  query.skip_bonds = family.apart ? 0 : 1;
  const std::size_t contacts = find_contacts(hierarchy, query, &stats).size();
  require_same(!family.apart || contacts == 0, fmt::format("contacts of the {} and none", family.name));
  const double law = std::pow(beads, family.exponent) * (family.logarithmic ? std::log2(beads) : 1);
  const double visited = static_cast<double>(stats.cage_pairs);
  const std::string text =
      fmt::format("n{}{}", family.exponent > 1 ? "^4/3" : "", family.logarithmic ? " lg n" : "");
  fmt::print("{:<20}{:>9}{:>13}{:>12.2f}{:>12}{:>12.3f}\n", family.name, shape.positions.size(),
             stats.cage_pairs, visited / beads, text, visited / law);
  return {{"shape", family.name}, {"beads", beads},          {"visited", visited},
          {"law", text},          {"to_law", visited / law}, {"contacts", static_cast<double>(contacts)}};
}

}  // namespace

Table measure_growth(std::int64_t most_beads) {
  Table table;
  fmt::print("{:<20}{:>9}{:>13}{:>12}{:>12}{:>12}\n", "shape", "beads", "visited", "per bead", "law",
             "to law");
  for (const Family& family : kFamilies) {
    for (std::int64_t n = 64; n <= most_beads; n *= 2) {
      table.push_back(measure(family, static_cast<std::int32_t>(n)));
    }
  }
  return table;
}

}  // namespace dch::bench

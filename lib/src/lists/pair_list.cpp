// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/index_count.hpp>
#include <dch/lists/pair_list.hpp>

#include "base/describe.hpp"
#include "geometry/lattice.hpp"

namespace dch {

Vec3 PairList::shift(const Group& group, const Box& now) {
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis)
    if (now.periodic(axis))
      sum = sum + static_cast<double>(group.image[static_cast<std::size_t>(axis)]) * now.vector(axis);
  return sum;
}

namespace detail {
namespace {

std::int32_t image_number(double n) {
  if (!(std::abs(n) <= static_cast<double>(kMaxIndexCount)))
    throw InvalidPosition("two positions are " + describe(n) +
                          " periods of the box away from each other's nearest images; images have 32-bit "
                          "numbers, so at most " +
                          std::to_string(kMaxIndexCount) + " are possible: wrap the coordinates first");
  return static_cast<std::int32_t>(n);
}

}  // namespace

PairListMaker::PairListMaker(const NeighborList& list, double list_radius, Span<const Vec3> positions,
                             const Box& box, Span<const std::int32_t> types, PairList& out)
    : positions_(positions),
      has_images_(box.any_periodic()),
      near2_(box.max_cutoff() * box.max_cutoff()),
      out_(out) {
  if (list.kind != ListKind::half)
    throw InvalidParameter("a pair list is made from a half neighbor list, but this one is full");
  if (list.size() != positions.size())
    throw InvalidParameter(std::to_string(positions.size()) + " positions given for a neighbor list of " +
                           std::to_string(list.size()) + " particles");
  if (!types.empty() && types.size() != list.size())
    throw InvalidParameter(std::to_string(types.size()) + " types given for a neighbor list of " +
                           std::to_string(list.size()) + " particles; give one each, or none");
  out.types = 1;
  for (const std::int32_t type : types) {
    if (type < 0) throw InvalidParameter("type " + std::to_string(type) + " of a particle is negative");
    index_count(std::int64_t{type} + 1, "types", "number them from 0");
    out.types = std::max(out.types, type + 1);
  }
  out.type.assign(types.begin(), types.end());
  const auto most = static_cast<std::size_t>(list.first.back()) + 1;  // add() writes one beyond
  out.i.resize(most);
  out.j.resize(most);
  out.groups.assign(1, {});
  out.particles = positions.size();
  out.list_radius = list_radius;
  out.box = box;
}

/// The number of an image's group, a new one if there is none yet.
std::size_t PairListMaker::group_of(const std::array<std::int32_t, 3>& image) {
  auto& groups = out_.groups;
  for (std::size_t g = 1; g < groups.size(); ++g)
    if (groups[g].image == image) return g;
  groups.push_back({image, 0});
  return groups.size() - 1;
}

/// Pairs of other images than that at home go behind the others, group by group in the order in which they
/// came, so that they stay close to each other in memory.
void PairListMaker::finish() {
  const Lattice images(out_.box);
  std::vector<std::size_t> group(far_.size());
  for (std::size_t k = 0; k < far_.size(); ++k) {
    const Vec3 d =
        positions_[static_cast<std::size_t>(far_[k][1])] - positions_[static_cast<std::size_t>(far_[k][0])];
    const Vec3 n = images.integers(out_.box.nearest_image(d) - d);
    group[k] = group_of({image_number(n.x), image_number(n.y), image_number(n.z)});
    ++out_.groups[group[k]].first;  // counts, for now
  }
  auto& groups = out_.groups;
  auto total = static_cast<std::int64_t>(near_);
  groups[0].first = 0;
  for (std::size_t g = 1; g < groups.size(); ++g) total = std::exchange(groups[g].first, total) + total;
  groups.push_back({{}, total});
  out_.i.resize(static_cast<std::size_t>(total));
  out_.j.resize(static_cast<std::size_t>(total));
  std::vector<std::int64_t> next;
  next.reserve(groups.size());
  for (const PairList::Group& g : groups) next.push_back(g.first);
  for (std::size_t k = 0; k < far_.size(); ++k) {
    const auto to = static_cast<std::size_t>(next[group[k]]++);
    out_.i[to] = far_[k][0];
    out_.j[to] = far_[k][1];
  }
}

}  // namespace detail
}  // namespace dch

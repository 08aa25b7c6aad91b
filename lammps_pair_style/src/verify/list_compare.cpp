// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <tuple>
#include <utility>

namespace dch::lammps {
namespace {

std::tuple<std::int64_t, std::int64_t, int> identity(const AtomPair& p) { return {p.low, p.high, p.special}; }

bool close(Vec3 a, Vec3 b, double tolerance) {
  const Vec3 d = a - b;
  return std::abs(d.x) <= tolerance && std::abs(d.y) <= tolerance && std::abs(d.z) <= tolerance;
}

/// Of d and -d, the one whose first component that is not mere rounding is positive.
Vec3 canonical_direction(Vec3 d) {
  const double noise = 1e-9 * std::sqrt(norm2(d));
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(d[axis]) > noise) return d[axis] > 0 ? d : -1.0 * d;
  }
  return d;
}

}  // namespace

ListDifference compare_entries(std::vector<ListEntry> native, std::vector<ListEntry> dch) {
  std::sort(native.begin(), native.end());
  std::sort(dch.begin(), dch.end());
  ListDifference out;
  std::set_difference(native.begin(), native.end(), dch.begin(), dch.end(),
                      std::back_inserter(out.native_only));
  std::set_difference(dch.begin(), dch.end(), native.begin(), native.end(), std::back_inserter(out.dch_only));
  return out;
}

double AtomPair::distance() const { return std::sqrt(norm2(displacement)); }

AtomPair make_atom_pair(std::int64_t tag_i, std::int64_t tag_j, Vec3 d, int special, bool native) {
  if (tag_i > tag_j) return {tag_j, tag_i, -1.0 * d, special, native};
  if (tag_i == tag_j) d = canonical_direction(d);
  return {tag_i, tag_j, d, special, native};
}

std::vector<AtomPair> unmatched(std::vector<AtomPair> pairs, double tolerance) {
  std::sort(pairs.begin(), pairs.end(), [](const AtomPair& a, const AtomPair& b) {
    return std::tuple_cat(identity(a), std::make_tuple(a.native)) <
           std::tuple_cat(identity(b), std::make_tuple(b.native));
  });
  std::vector<AtomPair> out;
  for (auto group = pairs.begin(); group != pairs.end();) {
    const auto end =
        std::find_if(group, pairs.end(), [&](const AtomPair& p) { return identity(p) != identity(*group); });
    const auto first_native = std::find_if(group, end, [](const AtomPair& p) { return p.native; });
    std::vector<AtomPair> ours(group, first_native);
    for (auto native = first_native; native != end; ++native) {
      const auto partner = std::find_if(ours.begin(), ours.end(), [&](const AtomPair& p) {
        return close(p.displacement, native->displacement, tolerance);
      });
      if (partner == ours.end()) {
        out.push_back(*native);
      } else {
        ours.erase(partner);
      }
    }
    out.insert(out.end(), ours.begin(), ours.end());
    group = end;
  }
  return out;
}

void drop_at_cutoff(std::vector<AtomPair>& pairs) {
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const AtomPair& p) { return p.at_cutoff; }),
              pairs.end());
}

std::string describe(const AtomPair& pair) {
  char text[200];
  std::snprintf(text, sizeof text,
                "pair of atoms %lld and %lld at distance %.10g, special bits %d: in the %s list only",
                static_cast<long long>(pair.low), static_cast<long long>(pair.high), pair.distance(),
                pair.special, pair.native ? "native" : "DCH");
  return text;
}

}  // namespace dch::lammps

// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch with mistakes in what force styles get in place of neighbor lists, to see that `dch verify` finds
// them:
//     lmp_faulty_clusters none|drop|repeat|image|exclusions|bonds|weights [LAMMPS options]
// From the third search on
//     drop        a pair of cluster pairs, or of the pair list, is left out
//     repeat      one is there twice
//     image       pairs through a face of the box lead to the image behind the one that is meant
//     exclusions  `neigh_modify exclude` is forgotten
//     bonds       bonded pairs are taken for ordinary ones
//     weights     a bonded pair has the weight of another kind
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <input.h>
#include <lammps_host.h>
#include <memory>
#include <neighbor.h>
#include <string>

#include "dch_command.h"
#include "dch_register.h"
#include "neighbor_dch.h"

namespace {

using LAMMPS_NS::AtomPoints;
using LAMMPS_NS::ClusterList;
using LAMMPS_NS::ClusterListFiller;

[[noreturn]] void no_place(const char* what) {
  std::fprintf(stderr, "no %s to plant the fault in\n", what);
  std::abort();
}

/// Index of the first of `count` things that fits.
std::size_t first_that(std::size_t count, const char* what, const std::function<bool(std::size_t)>& fits) {
  for (std::size_t k = 0; k < count; ++k)
    if (fits(k)) return k;
  no_place(what);
}

/// A pair of the home image that stays near: lists may hold some beyond their radius, which nobody misses.
std::size_t near_pair(const ClusterList& list, const double* const* x) {
  const dch::PairList& pairs = list.pair_list;
  const double limit = 0.95 * pairs.list_radius;
  return first_that(static_cast<std::size_t>(pairs.groups[1].first), "near pair", [&](std::size_t k) {
    const double *const from = x[pairs.i[k]], *const to = x[pairs.j[k]];
    return norm2(dch::Vec3{to[0] - from[0], to[1] - from[1], to[2] - from[2]}) < limit * limit;
  });
}

/// An entry with a pair of the same cluster, which is surely near.
std::size_t own_entry(const dch::ClusterPairs& pairs, std::size_t& row) {
  row = first_that(pairs.rows.size() - 1, "row", [&](std::size_t r) {
    return pairs.entries[static_cast<std::size_t>(pairs.rows[r].first)].cluster == pairs.rows[r].cluster;
  });
  return static_cast<std::size_t>(pairs.rows[row].first);
}

void drop(const double* const* x, ClusterList& list) {
  if (!list.one_by_one) {
    std::size_t row = 0;
    auto& mask = list.pairs.entries[own_entry(list.pairs, row)].mask;
    mask = static_cast<std::uint16_t>(mask & (mask - 1));
    return;
  }
  dch::PairList& pairs = list.pair_list;
  const auto k = static_cast<std::ptrdiff_t>(near_pair(list, x));
  pairs.i.erase(pairs.i.begin() + k);
  pairs.j.erase(pairs.j.begin() + k);
  for (std::size_t g = 1; g < pairs.groups.size(); ++g) --pairs.groups[g].first;
}

void repeat(const double* const* x, ClusterList& list) {
  if (!list.one_by_one) {
    std::size_t row = 0;
    const std::size_t k = own_entry(list.pairs, row);
    auto& entries = list.pairs.entries;
    dch::ClusterPairs::Entry once_more = entries[k];
    once_more.mask = static_cast<std::uint16_t>(once_more.mask & -once_more.mask);
    entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(k), once_more);
    for (std::size_t r = row + 1; r < list.pairs.rows.size(); ++r) ++list.pairs.rows[r].first;
    return;
  }
  dch::PairList& pairs = list.pair_list;
  const auto k = static_cast<std::ptrdiff_t>(near_pair(list, x));
  pairs.i.insert(pairs.i.begin() + k, pairs.i[static_cast<std::size_t>(k)]);
  pairs.j.insert(pairs.j.begin() + k, pairs.j[static_cast<std::size_t>(k)]);
  for (std::size_t g = 1; g < pairs.groups.size(); ++g) ++pairs.groups[g].first;
}

/// All that lead to another image, since any one of them may hold no pair but such as nobody misses.
void other_image(const AtomPoints& points, ClusterList& list) {
  if (list.one_by_one) {
    if (list.pair_list.groups.size() < 3) no_place("group of another image");
    for (std::size_t g = 1; g + 1 < list.pair_list.groups.size(); ++g) ++list.pair_list.groups[g].image[0];
    return;
  }
  dch::ClusterPairs& pairs = list.pairs;
  bool is_planted = false;
  for (auto& shift : pairs.shift) {
    if (norm2(shift.image) == 0) continue;
    shift.image.x += 1;
    is_planted = true;
  }
  if (!is_planted) no_place("shift to another image");
  pairs.has_shift_vectors = false;
  pairs.refresh({points.positions().data(), pairs.particles}, points.box());
}

void other_weight(ClusterList& list) {
  if (list.special.size() == 0) no_place("bonded pair");
  list.special.kind.front() = 1 + list.special.kind.front() % 3;
}

std::string fault;

class FaultyFiller : public ClusterListFiller {
 public:
  FaultyFiller(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::SpecialPairs& special, const LAMMPS_NS::PairRules& rules)
      : ClusterListFiller(lammps, special, rules),
        forgotten_(rules),
        forgetful_(lammps, special, forgotten_) {}

  void fill(AtomPoints& points, dch::PairSearch& search, double skin, ClusterList& list) override {
    const bool is_faulty = ++fills_ >= 3;
    if (is_faulty && fault == "exclusions") return forgetful_.fill(points, search, skin, list);
    const int flag_of_bonds = neighbor->special_flag[1];
    if (is_faulty && fault == "bonds") neighbor->special_flag[1] = 1;
    ClusterListFiller::fill(points, search, skin, list);
    neighbor->special_flag[1] = flag_of_bonds;
    if (!is_faulty) return;
    if (fault == "drop") drop(atom->x, list);
    if (fault == "repeat") repeat(atom->x, list);
    if (fault == "image") other_image(points, list);
    if (fault == "weights") other_weight(list);
  }

 private:
  int fills_ = 0;
  LAMMPS_NS::PairRules forgotten_;  ///< excludes nothing
  ClusterListFiller forgetful_;
};

std::unique_ptr<ClusterListFiller> make_faulty(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::SpecialPairs& special,
                                               const LAMMPS_NS::PairRules& rules) {
  return std::make_unique<FaultyFiller>(lammps, special, rules);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::array<const char*, 7> kFaults{"none",       "drop",  "repeat", "image",
                                               "exclusions", "bonds", "weights"};
  MPI_Init(&argc, &argv);
  fault = argc > 1 ? argv[1] : "";
  if (std::find(kFaults.begin(), kFaults.end(), fault) == kFaults.end()) {
    std::fprintf(stderr, "lmp_faulty_clusters: no fault '%s'\n", fault.c_str());
    return 2;
  }
  auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc - 1, argv + 1, MPI_COMM_WORLD);
  if (dch_register(lammps.get()) != 0) return 1;
  LAMMPS_NS::NeighborParts parts;
  parts.cluster_filler = make_faulty;
  LAMMPS_NS::NeighborDCH::install(lammps.get(), parts);
  lammps->input->file();
  lammps.reset();
  MPI_Finalize();
  return 0;
}

// SPDX-License-Identifier: GPL-2.0-or-later
// Runs a script in lmp-dch, then steps one by one, and after each of them looks at all pairs of atoms:
// whoever is within the cutoff has to be in a list, and forces have to be those of all pairs.
//     expiry_oracle none|blind lists|forces|both STEPS SCRIPT [LAMMPS options]
// blind: the search says of every list that it lacks no pair. Forces are Lennard-Jones ones, with epsilon and
// sigma 1, cut off where the pair style cuts them off. Prints how many steps were looked at, how many builds
// there were, how many pairs were missing and by how much forces were wrong; status 1 if any was.
#include <algorithm>
#include <array>
#include <atom.h>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <domain.h>
#include <force.h>
#include <input.h>
#include <lammps_host.h>
#include <memory>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>
#include <string>
#include <utility>
#include <vector>

#include <dch/engines/pair_search.hpp>

#include "dch_register.h"
#include "neighbor_dch.h"

namespace {

/// A pair of IDs, the smaller one first, and the box vectors between them.
using Key = std::array<int, 5>;
using Vec = std::array<double, 3>;

constexpr double kForceError = 1e-9;  ///< relative to the largest force

class BlindSearch : public dch::PairSearch {
 public:
  BlindSearch(const std::string& engine, const dch::HierarchyParams& params)
      : good_(dch::make_search(engine, params)) {}
  void update(dch::Span<const dch::Vec3> positions, const dch::Box& box,
              dch::Span<const std::uint64_t> keys) override {
    good_->update(positions, box, keys);
  }
  void list(const dch::ListParams& params, dch::NeighborList& out) override { good_->list(params, out); }
  void cluster_pairs(const dch::ListParams& params, dch::ClusterPairs& out) override {
    good_->cluster_pairs(params, out);
  }
  bool has_cluster_pairs() const override { return good_->has_cluster_pairs(); }
  dch::UnlistedPair unlisted_pair(const dch::UnlistedQuestion&) override { return dch::UnlistedPair::none; }
  const dch::SearchStats& stats() const override { return good_->stats(); }
  std::string name() const override { return "blind"; }

 private:
  std::unique_ptr<dch::PairSearch> good_;
};

std::unique_ptr<dch::PairSearch> make_blind(const std::string& engine, const dch::HierarchyParams& params) {
  return std::make_unique<BlindSearch>(engine, params);
}

/// The scenes here have few atoms, whose IDs are the first numbers.
int short_id(LAMMPS_NS::tagint id) { return static_cast<int>(id); }

/// Atoms of all processes by their IDs, which are 1 to their number, and the box.
struct Scene {
  explicit Scene(LAMMPS_NS::LAMMPS& lammps) : count(static_cast<int>(lammps.atom->natoms)) {
    const LAMMPS_NS::Atom& atom = *lammps.atom;
    at = gather<3>(atom, atom.x[0], MPI_DOUBLE);
    forces = gather<3>(atom, atom.f[0], MPI_DOUBLE);
    types = gather<1>(atom, atom.type, MPI_INT);
    if (atom.radius_flag) radii = gather<1>(atom, atom.radius, MPI_DOUBLE);
    const double* const h = lammps.domain->h;
    cell = {{{h[0], 0, 0}, {h[5], h[1], 0}, {h[4], h[3], h[2]}}};
    for (int axis = 0; axis < 3; ++axis) reach[axis] = lammps.domain->periodicity[axis] ? 2 : 0;
    cutsq = lammps.force->pair->cutsq;
  }
  /// By ID, so many numbers of each. LAMMPS's own function knows no long IDs.
  template <std::size_t kNumbers, class Number>
  std::vector<Number> gather(const LAMMPS_NS::Atom& atom, const Number* own, MPI_Datatype type) const {
    std::vector<Number> all(kNumbers * static_cast<std::size_t>(count));
    for (int i = 0; i < atom.nlocal; ++i)
      std::copy_n(own + kNumbers * static_cast<std::size_t>(i), kNumbers,
                  all.begin() + static_cast<std::ptrdiff_t>(kNumbers) * short_id(atom.tag[i] - 1));
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), type, MPI_SUM, MPI_COMM_WORLD);
    return all;
  }
  /// Squared, of atoms i and j; both from 1.
  double cutoff2(int i, int j) const {
    const auto a = static_cast<std::size_t>(i - 1), b = static_cast<std::size_t>(j - 1);
    if (radii.empty()) return cutsq[types[a]][types[b]];
    return (radii[a] + radii[b]) * (radii[a] + radii[b]);
  }
  /// From atom i to an image of atom j; both from 1.
  Vec between(int i, int j, const std::array<int, 3>& image) const {
    Vec d;
    for (int k = 0; k < 3; ++k) {
      d[k] = at[3 * static_cast<std::size_t>(j - 1) + k] - at[3 * static_cast<std::size_t>(i - 1) + k];
      for (int axis = 0; axis < 3; ++axis) d[k] += image[axis] * cell[axis][k];
    }
    return d;
  }
  /// Whole box vectors that a displacement is longer than that of the atoms where they are.
  std::array<int, 3> image_of(int i, int j, Vec d) const {
    const Vec plain = between(i, j, {0, 0, 0});
    for (int k = 0; k < 3; ++k) d[k] -= plain[k];
    std::array<int, 3> image{};
    for (int axis = 2; axis >= 0; --axis) {
      image[axis] = static_cast<int>(std::lround(d[axis] / cell[axis][axis]));
      for (int k = 0; k < 3; ++k) d[k] -= image[axis] * cell[axis][k];
    }
    return image;
  }

  int count;
  std::vector<double> at, forces, radii;  ///< radii of spheres, whose sums are cutoffs
  std::vector<int> types;
  std::array<Vec, 3> cell{};
  int reach[3];
  double** cutsq;
};

Key key_of(int i, int j, const std::array<int, 3>& n) {
  if (i < j || (i == j && n > std::array<int, 3>{0, 0, 0})) return {i, j, n[0], n[1], n[2]};
  return {j, i, -n[0], -n[1], -n[2]};
}

/// All numbers of all processes.
std::vector<int> gather(std::vector<int> mine) {
  int processes = 0, count = static_cast<int>(mine.size());
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  std::vector<int> counts(static_cast<std::size_t>(processes)), first(counts.size(), 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (std::size_t p = 1; p < first.size(); ++p) first[p] = first[p - 1] + counts[p - 1];
  std::vector<int> all(static_cast<std::size_t>(first.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, MPI_INT, all.data(), counts.data(), first.data(), MPI_INT,
                 MPI_COMM_WORLD);
  return all;
}

/// Sorted pairs of all lists that are kept up, and of bonded atoms, which lists may leave out.
std::vector<Key> listed_pairs(LAMMPS_NS::LAMMPS& lammps, const Scene& scene) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  std::vector<int> numbers;
  for (int m = 0; m < lammps.neighbor->nlist; ++m) {
    const LAMMPS_NS::NeighList& list = *lammps.neighbor->lists[m];
    for (int row = 0; row < (list.occasional ? 0 : list.inum); ++row) {
      const int i = list.ilist[row];
      for (int k = 0; k < list.numneigh[i]; ++k) {
        const int j = list.firstneigh[i][k] & NEIGHMASK;
        const Vec d{atom.x[j][0] - atom.x[i][0], atom.x[j][1] - atom.x[i][1], atom.x[j][2] - atom.x[i][2]};
        const int own = short_id(atom.tag[i]), other = short_id(atom.tag[j]);
        const Key key = key_of(own, other, scene.image_of(own, other, d));
        numbers.insert(numbers.end(), key.begin(), key.end());
      }
    }
  }
  const std::vector<int> all = gather(std::move(numbers));
  std::vector<Key> keys;
  for (std::size_t k = 0; k < all.size(); k += 5)
    keys.push_back({all[k], all[k + 1], all[k + 2], all[k + 3], all[k + 4]});
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// IDs of bonded atoms, in pairs, sorted.
std::vector<std::pair<int, int>> bonded_pairs(LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  std::vector<int> numbers;
  for (int i = 0; atom.molecular != LAMMPS_NS::Atom::ATOMIC && i < atom.nlocal; ++i)
    for (int k = 0; k < atom.nspecial[i][0]; ++k) {
      numbers.push_back(short_id(atom.tag[i]));
      numbers.push_back(short_id(atom.special[i][k]));
    }
  const std::vector<int> all = gather(std::move(numbers));
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t k = 0; k < all.size(); k += 2) pairs.emplace_back(all[k], all[k + 1]);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Calls use(i, j, image, displacement) for all pairs within their cutoffs. Box vectors have no coordinate
/// beyond their own, so a sum of some that is too far along the last axes stays so.
template <class Use>
void for_images(const Scene& scene, int i, int j, double cut2, const Use& use) {
  const auto is_beyond = [&](double length) { return length * length > cut2; };
  const Vec plain = scene.between(i, j, {0, 0, 0});
  for (int c = -scene.reach[2]; c <= scene.reach[2]; ++c) {
    if (is_beyond(plain[2] + c * scene.cell[2][2])) continue;
    for (int b = -scene.reach[1]; b <= scene.reach[1]; ++b) {
      if (is_beyond(plain[1] + b * scene.cell[1][1] + c * scene.cell[2][1])) continue;
      for (int a = -scene.reach[0]; a <= scene.reach[0]; ++a) {
        const std::array<int, 3> image{a, b, c};
        if (i == j && image <= std::array<int, 3>{0, 0, 0}) continue;
        const Vec d = scene.between(i, j, image);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < cut2) use(i, j, image, d);
      }
    }
  }
}

template <class Use>
void for_near_pairs(const Scene& scene, const Use& use) {
  for (int i = 1; i <= scene.count; ++i)
    for (int j = i; j <= scene.count; ++j) for_images(scene, i, j, scene.cutoff2(i, j), use);
}

struct Found {
  long pairs = 0, missing = 0;
  double force_error = 0;
};

void check_lists(LAMMPS_NS::LAMMPS& lammps, const Scene& scene, Found& found) {
  const std::vector<Key> listed = listed_pairs(lammps, scene);
  const auto bonded = bonded_pairs(lammps);
  for_near_pairs(scene, [&](int i, int j, const std::array<int, 3>& image, const Vec&) {
    if (std::binary_search(bonded.begin(), bonded.end(), std::pair<int, int>(i, j))) return;
    ++found.pairs;
    found.missing += !std::binary_search(listed.begin(), listed.end(), key_of(i, j, image));
  });
}

/// Of a number and a NaN, the NaN.
double larger(double a, double b) { return std::isnan(a) || b <= a ? a : b; }

void check_forces(const Scene& scene, Found& found) {
  std::vector<double> sums(scene.forces.size(), 0);
  for_near_pairs(scene, [&](int i, int j, const std::array<int, 3>&, const Vec& d) {
    const double s2 = 1 / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), s6 = s2 * s2 * s2;
    for (int k = 0; k < 3; ++k) {
      const double part = (48 * s6 - 24) * s6 * s2 * d[k];
      sums[3 * static_cast<std::size_t>(i - 1) + k] -= part;
      sums[3 * static_cast<std::size_t>(j - 1) + k] += part;
    }
  });
  double largest = 1, error = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    largest = std::max(largest, std::abs(sums[k]));
    error = larger(error, std::abs(sums[k] - scene.forces[k]));
  }
  found.force_error = larger(found.force_error, error / largest);
}

/// Steps on the lists of the run before.
Found follow(LAMMPS_NS::LAMMPS& lammps, int steps, const std::string& what) {
  Found found;
  for (int step = 0; step < steps; ++step) {
    lammps.input->one("run 1 pre no post no");
    const Scene scene(lammps);
    if (what != "forces") check_lists(lammps, scene, found);
    if (what != "lists") check_forces(scene, found);
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc < 5) {
    std::fprintf(stderr, "usage: expiry_oracle none|blind lists|forces|both STEPS SCRIPT [LAMMPS options]\n");
    return 2;
  }
  const bool is_blind = std::string(argv[1]) == "blind";
  const int steps = std::atoi(argv[3]);
  std::vector<char*> options{argv[0]};
  options.insert(options.end(), argv + 5, argv + argc);
  auto lammps =
      std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(options.size()), options.data(), MPI_COMM_WORLD);
  if (dch_register(lammps.get()) != 0) return 1;
  if (is_blind) LAMMPS_NS::NeighborDCH::install(lammps.get(), {make_blind});
  lammps->input->file(argv[4]);
  const Found found = follow(*lammps, steps, argv[2]);
  lammps->input->one("dch stats");
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    std::printf("oracle: %d steps, %d builds, %ld pairs, %ld missing, forces off by %.3g\n", steps,
                static_cast<int>(lammps->neighbor->ncalls), found.pairs, found.missing, found.force_error);
  lammps.reset();
  MPI_Finalize();
  if (found.missing > 0) return 3;
  return found.force_error <= kForceError ? 0 : 4;
}

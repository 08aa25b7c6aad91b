// SPDX-License-Identifier: MIT
//
// Densities and forces of embedded atoms are added whole or not at all, and right the next time.
#include <dch/forces/embedded_atoms.hpp>

#include "cluster_pair_check.hpp"
#include "scene.hpp"

namespace dch::faults {
namespace {

EmbeddedAtomParams params_of_two_types() {
  EmbeddedAtomParams params;
  params.types = 2;
  params.cutoff = 1;
  params.distance_step = 0.25;
  params.density_step = 0.5;
  params.densities.assign(4, {5, 4, 3, 2, 1, 0});
  params.densities[1] = {4, 3, 2, 2, 1, 0};
  params.pairs.assign(4, {3, 2, 1, 1, 0, 0});
  params.embeddings.assign(2, {0, -1, -2, -2, -3});
  return params;
}

/// Two pairs, whose densities and forces are added in turn.
struct Dimers {
  EmbeddedAtoms atoms = EmbeddedAtoms(params_of_two_types());
  std::vector<double> densities = std::vector<double>(3);
  std::vector<Vec3> forces = std::vector<Vec3>(3);

  void add() {
    static const std::vector<Vec3> positions = {{0, 0, 0}, {0.6, 0, 0}, {0, 0.7, 0}};
    static const std::vector<std::int32_t> types = {1, 2, 1}, with_rows = {0}, row = {1, 2};
    static const std::int32_t counts[] = {2, 0, 0};
    static const std::int32_t* const rows[] = {row.data(), nullptr, nullptr};
    const NeighborRows list{with_rows, counts, rows};
    atoms.add_densities(list, positions, types, densities);
    atoms.add_forces(list, types, densities, forces);
  }
};

TEST(EmbeddedFaults, DensitiesAndForcesAreAddedWholeOrNot) {
  Dimers expected, twice;
  expected.add();
  twice.densities = expected.densities;
  twice.add();
  expect_sound(
      sweep([] { return Dimers(); }, [](Dimers& subject) { subject.add(); },
            [&](Dimers& subject, Ending ending) -> std::string {
              const bool none = subject.densities == std::vector<double>(3);
              if (!none && subject.densities != expected.densities)
                return after(ending, "densities are neither as before nor right");
              if (subject.forces != (ending == Ending::threw ? std::vector<Vec3>(3) : expected.forces))
                return after(ending, "forces are neither as before nor right");
              if (ending != Ending::threw) return "";
              subject.add();
              return subject.forces == (none ? expected : twice).forces ? ""
                                                                        : "forces are wrong the next time";
            }),
      3);
}

TEST(EmbeddedFaults, FunctionsAreMadeOrNot) {
  expect_sound(sweep([] { return params_of_two_types(); },
                     [](const EmbeddedAtomParams& params) { EmbeddedAtoms{params}; },
                     [](const EmbeddedAtomParams&, Ending) { return std::string(); }),
               10);
}

}  // namespace
}  // namespace dch::faults

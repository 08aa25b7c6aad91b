// SPDX-License-Identifier: MIT
//
// Reciprocal space wave by wave equals the textbook's complex sum.
#include <complex>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/ewald_mesh.hpp>
#include <dch/forces/ewald_waves.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

constexpr double kWaveSplitting = 1.3, kWaveConstant = 2.5;
const Vec3 kWaveLengths{5, 6.5, 4};
const Box kWaveBox = Box::orthorhombic(kWaveLengths);

struct Ions {
  std::vector<Vec3> at;
  std::vector<double> charge;
};

/// In any image.
Ions make_ions(std::size_t n, std::uint64_t seed) {
  scenes::Random random(seed);
  Ions made;
  for (std::size_t i = 0; i < n; ++i) {
    made.at.push_back(
        {random.uniform(-20, 20), random.uniform(0, 6.5), i == 0 ? -1e-18 : random.uniform(0, 400)});
    made.charge.push_back(random.uniform(-1, 1));
  }
  return made;
}

struct IonForces {
  double energy = 0;
  std::vector<Vec3> forces;
};

IonForces by_waves(std::array<int, 3> count, const Ions& charges, Executor* executor = nullptr) {
  EwaldWaves waves(count, kWaveSplitting, kWaveConstant);
  waves.set_executor(executor);
  IonForces found{0, std::vector<Vec3>(charges.at.size())};
  found.energy = waves.add_forces(charges.at, charges.charge, kWaveBox, found.forces);
  return found;
}

/// Over all waves but that of number 0, each with its complex sum.
IonForces wave_by_wave(const std::array<int, 3>& count, const Ions& charges) {
  const double pi = std::acos(-1.0);
  IonForces found{0, std::vector<Vec3>(charges.at.size())};
  for (int x = 1 - count[0]; x < count[0]; ++x)
    for (int y = 1 - count[1]; y < count[1]; ++y)
      for (int z = 1 - count[2]; z < count[2]; ++z) {
        const Vec3 k{2 * pi * x / kWaveLengths.x, 2 * pi * y / kWaveLengths.y, 2 * pi * z / kWaveLengths.z};
        if (norm2(k) == 0) continue;
        std::vector<std::complex<double>> of;
        std::complex<double> total = 0;
        for (std::size_t i = 0; i < charges.at.size(); ++i) {
          of.push_back(charges.charge[i] * std::polar(1.0, dot(k, charges.at[i])));
          total += of.back();
        }
        const double weight = 2 * pi * kWaveConstant / kWaveBox.volume() *
                              std::exp(-norm2(k) / (4 * kWaveSplitting * kWaveSplitting)) / norm2(k);
        found.energy += weight * std::norm(total);
        for (std::size_t i = 0; i < of.size(); ++i)
          found.forces[i] = found.forces[i] + 2 * weight * (std::conj(total) * of[i]).imag() * k;
      }
  return found;
}

TEST(EwaldWavesTest, EqualTheComplexSum) {
  const RestoreInstructionSet restore;
  // No charge, one, whole blocks of 64, and more than what one thread takes at a time; a single wave number.
  for (const std::size_t n : {0, 1, 7, 64, 129, 600})
    for (const std::array<int, 3>& count : {std::array<int, 3>{6, 7, 5}, {1, 4, 2}, {9, 1, 1}, {1, 1, 1}}) {
      const Ions charges = make_ions(n, n + 1);
      const IonForces expected = wave_by_wave(count, charges);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        const IonForces found = by_waves(count, charges);
        EXPECT_NEAR(found.energy, expected.energy, 1e-12 * expected.energy) << name(set) << n;
        if (expected.energy == 0) continue;

        EXPECT_LT(force_error(found.forces, expected.forces), 1e-11) << name(set) << n;
      }
    }
}

TEST(EwaldWavesTest, EnoughOfThemEqualAMesh) {
  const Ions charges = make_ions(100, 5);
  const IonForces waves = by_waves({14, 18, 12}, charges);
  EwaldMesh mesh({60, 80, 50}, kWaveSplitting, kWaveConstant);
  IonForces found{0, std::vector<Vec3>(100)};
  found.energy = mesh.add_forces(charges.at, charges.charge, kWaveBox, found.forces);
  EXPECT_NEAR(found.energy / waves.energy, 1, 1e-5);
  EXPECT_LT(force_error(found.forces, waves.forces), 1e-5);
}

TEST(EwaldWavesTest, ThreadsGiveTheSameBits) {
  const Ions charges = make_ions(3000, 3);
  const IonForces alone = by_waves({5, 6, 4}, charges);
  for (const int threads : {2, 5, 40}) {
    const auto pool = make_thread_pool(threads);
    const IonForces found = by_waves({5, 6, 4}, charges, pool.get());
    EXPECT_EQ(found.energy, alone.energy);
    for (std::size_t i = 0; i < alone.forces.size(); ++i)
      EXPECT_TRUE(found.forces[i].x == alone.forces[i].x && found.forces[i].y == alone.forces[i].y &&
                  found.forces[i].z == alone.forces[i].z);
  }
}

TEST(EwaldWavesTest, AddToForcesAndFollowTheBox) {
  const Ions charges = make_ions(30, 4);
  EwaldWaves kept({5, 6, 4}, kWaveSplitting, kWaveConstant);
  std::vector<Vec3> forces(30, Vec3{1, 2, 3}), wide(30), again(30);
  kept.add_forces(charges.at, charges.charge, kWaveBox, forces);
  kept.add_forces(charges.at, charges.charge, Box::orthorhombic({8, 9, 10}), wide);
  EXPECT_EQ(kept.add_forces(charges.at, charges.charge, kWaveBox, again),
            by_waves({5, 6, 4}, charges).energy);
  for (Vec3& force : forces) force = force - Vec3{1, 2, 3};
  EXPECT_LT(force_error(forces, again), 1e-14);
  EXPECT_GT(force_error(wide, again), 0.1);
}

TEST(EwaldWavesTest, RefuseWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(EwaldWaves({0, 8, 8}, 1, 1), InvalidParameter);
  EXPECT_THROW(EwaldWaves({8, 8, 2000}, 1, 1), InvalidParameter);
  EXPECT_THROW(EwaldWaves({8, 8, 8}, 0, 1), InvalidParameter);
  EXPECT_THROW(EwaldWaves({8, 8, 8}, nan, 1), InvalidParameter);
  EXPECT_THROW(EwaldWaves({8, 8, 8}, 1, -1), InvalidParameter);
  EwaldWaves waves({8, 8, 8}, 1, 1);
  std::vector<Vec3> two(2), forces(2);
  const std::vector<double> charges{1, -1}, one{1};
  EXPECT_THROW(waves.add_forces(two, one, kWaveBox, forces), InvalidParameter);
  EXPECT_THROW(waves.add_forces(two, charges, Box::none(), forces), InvalidBox);
  EXPECT_THROW(waves.add_forces(two, charges, Box::orthorhombic({5, 5, 5}, {true, true, false}), forces),
               InvalidBox);
  EXPECT_THROW(waves.add_forces(two, charges, Box::triclinic({5, 0, 0}, {1, 6, 0}, {0, 0, 7}), forces),
               InvalidBox);
  two[1].y = nan;
  EXPECT_THROW(waves.add_forces(two, charges, kWaveBox, forces), InvalidPosition);
  two[1].y = 1;
  EXPECT_GT(waves.add_forces(two, charges, kWaveBox, forces), 0);
}

}  // namespace
}  // namespace dch

// SPDX-License-Identifier: MIT
//
// Reciprocal space on a mesh equals the method written down plainly in double, and, as meshes get finer, the
// sum over waves.
#include <complex>
#include <gtest/gtest.h>
#include <limits>

#include <dch/base/error.hpp>
#include <dch/forces/ewald_mesh.hpp>

#include "instruction_sets.hpp"
#include "lj_oracle.hpp"
#include "scenes.hpp"

namespace dch {
namespace {

using Complex = std::complex<double>;

constexpr double kSplitting = 1.4, kConstant = 3.5;
const Box kBox = Box::triclinic({5, 0, 0}, {1, 6, 0}, {-2, 1.5, 7});

struct Charges {
  std::vector<Vec3> at;
  std::vector<double> charge;
};

Charges make_charges(std::size_t n, std::uint64_t seed) {
  scenes::Random random(seed);
  Charges made;
  for (std::size_t i = 0; i < n; ++i) {
    made.at.push_back(scenes::from_fractional(
        kBox, {random.uniform(-3, 3), random.uniform(), i == 0 ? -1e-18 : random.uniform(-100, 100)}));
    made.charge.push_back(random.uniform(-1, 1));
  }
  return made;
}

struct Found {
  double energy = 0;
  std::vector<Vec3> forces;
};

Found by_mesh(std::array<int, 3> sizes, const Charges& charges, Executor* executor = nullptr,
              LatticeSum of = LatticeSum::coulomb) {
  EwaldMesh mesh(sizes, kSplitting, kConstant, of);
  mesh.set_executor(executor);
  Found found{0, std::vector<Vec3>(charges.at.size())};
  found.energy = mesh.add_forces(charges.at, charges.charge, kBox, found.forces);
  return found;
}

/// Cells' vectors times integers, in reciprocal space.
Vec3 wave(int x, int y, int z) {
  const Vec3 a = kBox.vector(0), b = kBox.vector(1), c = kBox.vector(2);
  const double volume = dot(a, cross(b, c));
  return (x / volume) * cross(b, c) + (y / volume) * cross(c, a) + (z / volume) * cross(a, b);
}

double weight_of(double m2, LatticeSum of) {
  const double pi = std::acos(-1.0);
  if (of == LatticeSum::dispersion) {
    // The Fourier transform of 1 / r^6 beyond x = splitting r of about 1 (Essmann et al., 1995).
    const double b = pi * std::sqrt(m2) / kSplitting;
    const double shape = (1 - 2 * b * b) * std::exp(-b * b) + 2 * std::sqrt(pi) * b * b * b * std::erfc(b);
    return -kConstant * std::pow(pi, 1.5) * std::pow(kSplitting, 3) / (3 * kBox.volume()) * shape;
  }
  return m2 == 0
             ? 0
             : kConstant * std::exp(-pi * pi * m2 / (kSplitting * kSplitting)) / (pi * kBox.volume() * m2);
}

/// Cardinal B-spline of order n, 0 unless 0 <= u < n.
double spline(int n, double u) {
  if (u < 0 || u >= n) return 0;
  return n == 1 ? 1 : (u * spline(n - 1, u) + (n - u) * spline(n - 1, u - 1)) / (n - 1);
}

/// The spline's squared amplitude at a wave; at the shortest one, where it vanishes, the mean of its
/// neighbors'.
double modulus(int m, int size) {
  if (2 * m == size) return 0.5 * (modulus(m - 1, size) + modulus(m + 1, size));
  Complex sum = 0;
  for (int j = 0; j < 4; ++j) sum += spline(5, j + 1) * std::polar(1.0, 2 * std::acos(-1.0) * m * j / size);
  return std::norm(sum);
}

/// A charge at `at` as seen from wave m along an axis: the sum over points of spline, or its slope, times
/// phase.
Complex seen(double at, int m, int size, bool slope) {
  const int last = static_cast<int>(std::floor(at));
  Complex sum = 0;
  for (int k = last - 4; k <= last; ++k) {
    const double u = at - k;
    const double value = slope ? spline(4, u) - spline(4, u - 1) : spline(5, u);
    sum += value * std::polar(1.0, 2 * std::acos(-1.0) * m * k / size);
  }
  return sum;
}

/// Smooth particle mesh Ewald as its authors wrote it: what the charges are on the mesh, seen from each wave.
/// Forces are the energy's slopes, by splines' slopes.
Found plainly(const std::array<int, 3>& n, const Charges& charges, LatticeSum of) {
  Found found{0, std::vector<Vec3>(charges.at.size())};
  const std::size_t count = charges.at.size();
  std::vector<Vec3> at;
  for (const Vec3& p : charges.at) {
    const Vec3 f = kBox.fractional(p);
    // In one image; a shift of all charges by the same number of points would change nothing.
    at.push_back(
        {(f.x - std::floor(f.x)) * n[0], (f.y - std::floor(f.y)) * n[1], (f.z - std::floor(f.z)) * n[2]});
  }
  for (int x = 0; x < n[0]; ++x)
    for (int y = 0; y < n[1]; ++y)
      for (int z = 0; z < n[2]; ++z) {
        // The shortest wave along an axis stands for two, of either sign.
        const auto either = [](int m, int size, bool minus) {
          return 2 * m < size || (2 * m == size && !minus) ? m : m - size;
        };
        double weight = 0;
        for (int s = 0; s < 8; ++s)
          weight += weight_of(norm2(wave(either(x, n[0], (s & 1) != 0), either(y, n[1], (s & 2) != 0),
                                         either(z, n[2], (s & 4) != 0))),
                              of) /
                    8;
        const double influence = weight / (modulus(x, n[0]) * modulus(y, n[1]) * modulus(z, n[2]));
        Complex total = 0;
        std::vector<std::array<Complex, 3>> one(count), slope(count);
        for (std::size_t i = 0; i < count; ++i) {
          one[i] = {seen(at[i].x, x, n[0], false), seen(at[i].y, y, n[1], false),
                    seen(at[i].z, z, n[2], false)};
          slope[i] = {seen(at[i].x, x, n[0], true), seen(at[i].y, y, n[1], true),
                      seen(at[i].z, z, n[2], true)};
          total += charges.charge[i] * one[i][0] * one[i][1] * one[i][2];
        }
        found.energy += 0.5 * influence * std::norm(total);
        for (std::size_t i = 0; i < count; ++i) {
          const auto along = [&](const Complex& d) {
            return influence * charges.charge[i] * (std::conj(total) * d).real();
          };
          found.forces[i] = found.forces[i] -
                            n[0] * along(slope[i][0] * one[i][1] * one[i][2]) * wave(1, 0, 0) -
                            n[1] * along(one[i][0] * slope[i][1] * one[i][2]) * wave(0, 1, 0) -
                            n[2] * along(one[i][0] * one[i][1] * slope[i][2]) * wave(0, 0, 1);
        }
      }
  return found;
}

TEST(EwaldMeshTest, EqualsTheMethodWrittenPlainly) {
  const RestoreInstructionSet restore;
  Charges charges = make_charges(7, 1);
  charges.charge[3] = 0;
  for (const LatticeSum of : {LatticeSum::coulomb, LatticeSum::dispersion})
    // All radices, alone and together, odd sizes and the least ones.
    for (const std::array<int, 3> sizes :
         {std::array<int, 3>{10, 9, 14}, {7, 5, 12}, {16, 15, 8}, {5, 6, 7}, {8, 20, 5}}) {
      const Found expected = plainly(sizes, charges, of);
      for (const InstructionSet set : supported_sets()) {
        set_instruction_set(set);
        const Found found = by_mesh(sizes, charges, nullptr, of);
        EXPECT_NEAR(found.energy / expected.energy, 1, 2e-6) << name(set) << sizes[0];
        EXPECT_LT(force_error(found.forces, expected.forces), 3e-6) << name(set) << sizes[0];
      }
    }
}

TEST(EwaldMeshTest, FinerMeshesComeNearTheSumOverWaves) {
  const Charges charges = make_charges(40, 2);
  const double pi = std::acos(-1.0);
  Found expected{0, std::vector<Vec3>(charges.at.size())};
  constexpr int kMost = 14;
  for (int x = -kMost; x <= kMost; ++x)
    for (int y = -kMost; y <= kMost; ++y)
      for (int z = -kMost; z <= kMost; ++z) {
        const Vec3 m = wave(x, y, z);
        const double weight = weight_of(norm2(m), LatticeSum::coulomb);
        if (weight < 1e-12) continue;
        Complex total = 0;
        for (std::size_t i = 0; i < charges.at.size(); ++i)
          total += charges.charge[i] * std::polar(1.0, 2 * pi * dot(m, charges.at[i]));
        expected.energy += 0.5 * weight * std::norm(total);
        for (std::size_t i = 0; i < charges.at.size(); ++i) {
          const Complex of_i = charges.charge[i] * std::polar(1.0, 2 * pi * dot(m, charges.at[i]));
          expected.forces[i] = expected.forces[i] + 2 * pi * weight * (std::conj(total) * of_i).imag() * m;
        }
      }
  double last = 1;
  for (const int size : {12, 24, 48}) {
    const Found found = by_mesh({size, size, size}, charges);
    const double error = force_error(found.forces, expected.forces);
    EXPECT_LT(error, last / 8);
    EXPECT_NEAR(found.energy / expected.energy, 1, error);
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

/// What reciprocal space holds of two particles at a distance, or of one with itself: energy, and force / r.
std::array<double, 2> far_dispersion(double r2) {
  const double y = kSplitting * kSplitting * r2;
  if (r2 == 0) return {std::pow(kSplitting, 6) / 6, 0};
  const double shorter = 1 + y + y * y / 2, longer = shorter + y * y * y / 6;
  return {(1 - std::exp(-y) * shorter) / std::pow(r2, 3), 6 * (1 - std::exp(-y) * longer) / std::pow(r2, 4)};
}

/// All images up to some distance, and those beyond as if they were everywhere.
TEST(EwaldMeshTest, DispersionComesNearTheSumOverImages) {
  Charges atoms = make_charges(12, 5);
  for (double& coefficient : atoms.charge) coefficient = 1 + 0.2 * coefficient;
  const auto n = atoms.at.size();
  Found expected{0, std::vector<Vec3>(n)};
  constexpr double kFar = 36;
  double products = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double product = kConstant * atoms.charge[i] * atoms.charge[j];
      products += product;
      const Vec3 apart = kBox.nearest_image(atoms.at[i] - atoms.at[j]);
      constexpr int kMost = 10;
      for (int x = -kMost; x <= kMost; ++x)
        for (int y = -kMost; y <= kMost; ++y)
          for (int z = -kMost; z <= kMost; ++z) {
            const Vec3 d = apart + x * kBox.vector(0) + y * kBox.vector(1) + z * kBox.vector(2);
            if (norm2(d) > kFar * kFar) continue;
            const auto [energy, force] = far_dispersion(norm2(d));
            expected.energy -= 0.5 * product * energy;
            expected.forces[i] = expected.forces[i] - (product * force) * d;
          }
    }
  const double pi = std::acos(-1.0);
  expected.energy -= 0.5 * products * 4 * pi / (3 * std::pow(kFar, 3) * kBox.volume());
  double last = 2;
  for (const int size : {12, 24, 48}) {
    const Found found = by_mesh({size, size, size}, atoms, nullptr, LatticeSum::dispersion);
    const double error = force_error(found.forces, expected.forces);
    EXPECT_LT(error, last / 8);
    EXPECT_NEAR(found.energy / expected.energy, 1, std::max(error, 1e-6));
    last = error;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(EwaldMeshTest, ThreadsGiveTheSameBits) {
  const Charges charges = make_charges(500, 3);
  for (const LatticeSum of : {LatticeSum::coulomb, LatticeSum::dispersion}) {
    const Found alone = by_mesh({18, 21, 20}, charges, nullptr, of);
    for (const int threads : {2, 5, 40}) {
      const auto pool = make_thread_pool(threads);
      const Found found = by_mesh({18, 21, 20}, charges, pool.get(), of);
      EXPECT_EQ(found.energy, alone.energy);
      for (std::size_t i = 0; i < alone.forces.size(); ++i)
        EXPECT_TRUE(found.forces[i].x == alone.forces[i].x && found.forces[i].y == alone.forces[i].y &&
                    found.forces[i].z == alone.forces[i].z);
    }
  }
}

TEST(EwaldMeshTest, FollowsTheBox) {
  Charges charges = make_charges(30, 4);
  EwaldMesh kept({15, 16, 18}, kSplitting, kConstant);
  std::vector<Vec3> forces(30), again(30);
  const Box wide = Box::orthorhombic({8, 9, 10});
  const double energy = kept.add_forces(charges.at, charges.charge, wide, forces);
  std::vector<Vec3> ignored(30);
  kept.add_forces(charges.at, charges.charge, kBox, ignored);
  EXPECT_EQ(kept.add_forces(charges.at, charges.charge, wide, again), energy);
  EXPECT_EQ(force_error(again, forces), 0);
  EXPECT_NE(force_error(ignored, forces), 0);
}

TEST(EwaldMeshTest, SizesAreRaisedToProductsOfSmallPrimes) {
  EXPECT_EQ(EwaldMesh({11, 13, 22}, 1, 1).sizes(), (std::array<int, 3>{12, 14, 24}));
  EXPECT_EQ(EwaldMesh({53, 97, 121}, 1, 1).sizes(), (std::array<int, 3>{54, 98, 125}));
}

TEST(EwaldMeshTest, RefusesWhatDoesNotFit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(EwaldMesh({4, 8, 8}, 1, 1), InvalidParameter);
  EXPECT_THROW(EwaldMesh({8, 8, 20000}, 1, 1), InvalidParameter);
  EXPECT_THROW(EwaldMesh({8, 8, 8}, 0, 1), InvalidParameter);
  EXPECT_THROW(EwaldMesh({8, 8, 8}, nan, 1), InvalidParameter);
  EXPECT_THROW(EwaldMesh({8, 8, 8}, 1, -1), InvalidParameter);
  EwaldMesh mesh({8, 8, 8}, 1, 1);
  std::vector<Vec3> two(2), forces(2);
  const std::vector<double> charges{1, -1}, one{1};
  EXPECT_THROW(mesh.add_forces(two, one, kBox, forces), InvalidParameter);
  EXPECT_THROW(mesh.add_forces(two, charges, Box::none(), forces), InvalidBox);
  two[1].y = nan;
  EXPECT_THROW(mesh.add_forces(two, charges, kBox, forces), InvalidPosition);
  two[1].y = 1;
  EXPECT_LT(mesh.add_forces(two, charges, kBox, forces), 2);
}

}  // namespace
}  // namespace dch

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <dch/necklace/chains.hpp>
#include <dch/necklace/melt.hpp>

namespace {

using dch::IndexPair;
using dch::InvalidParameter;
using dch::Vec3;
using dch::necklace::Chains;
using dch::necklace::make_melt;
using dch::necklace::Melt;
using dch::necklace::MeltParams;
using dch::necklace::write_lammps_data;

MeltParams small_melt() {
  MeltParams params;
  params.chains = 20;
  params.beads_per_chain = 50;
  return params;
}

/// FNV-1a over the bits of the positions.
std::uint64_t hash(const Melt& melt) {
  std::uint64_t h = 14695981039346656037U;
  for (const Vec3& p : melt.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      const double x = p[axis];
      std::memcpy(&bits, &x, sizeof bits);
      for (int byte = 0; byte < 8; ++byte) h = (h ^ ((bits >> (8 * byte)) & 0xff)) * 1099511628211U;
    }
  }
  return h;
}

std::vector<Vec3> whole(const Melt& melt) {
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < melt.positions.size(); ++k) {
    Vec3 p = melt.positions[k];
    for (int axis = 0; axis < 3; ++axis) {
      p = p + static_cast<double>(melt.images[k][static_cast<std::size_t>(axis)]) * melt.box.vector(axis);
    }
    result.push_back(p);
  }
  return result;
}

TEST(Melt, HasTheDensityTheBondsAndTheDistancesAskedFor) {
  const MeltParams params = small_melt();
  const Melt melt = make_melt(params);
  ASSERT_EQ(melt.positions.size(), 1000U);
  ASSERT_EQ(melt.bonds.size(), 980U);
  EXPECT_NEAR(1000 / melt.box.volume(), params.density, 1e-12);
  const std::vector<Vec3> x = whole(melt);
  double nearest_13 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < x.size(); ++k) {
    if (melt.molecules[k] != melt.molecules[k - 1]) continue;
    EXPECT_NEAR(std::sqrt(norm2(x[k] - x[k - 1])), params.bond, 1e-12);
    if (k > 1 && melt.molecules[k] == melt.molecules[k - 2]) {
      nearest_13 = std::min(nearest_13, std::sqrt(norm2(x[k] - x[k - 2])));
    }
  }
  EXPECT_GE(nearest_13, params.min_distance_13 - 1e-12);
  EXPECT_LT(nearest_13, params.min_distance_13 + 0.02) << "the restriction should just bite";
}

TEST(Melt, LiesInTheBoxAndLeavesIt) {
  const Melt melt = make_melt(small_melt());
  bool crossed = false;
  for (std::size_t k = 0; k < melt.positions.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(melt.positions[k][axis], 0);
      EXPECT_LT(melt.positions[k][axis], melt.box.vector(axis)[axis]);
      crossed = crossed || melt.images[k][static_cast<std::size_t>(axis)] != 0;
    }
  }
  EXPECT_TRUE(crossed);
}

TEST(Melt, BondsAndMoleculesDescribeTheSameChains) {
  const Melt melt = make_melt(small_melt());
  const Chains by_bonds = Chains::from_bonds(melt.positions.size(), melt.bonds);
  const Chains by_molecules = Chains::from_molecules(melt.molecules);
  ASSERT_EQ(by_bonds.size(), 20U);
  EXPECT_EQ(by_bonds.bonds(), melt.bonds);
  EXPECT_EQ(by_molecules.bonds(), melt.bonds);
}

TEST(Melt, UnwrappingAgreesWithTheImages) {
  const Melt melt = make_melt(small_melt());
  const std::vector<Vec3> expected = whole(melt);
  const std::vector<Vec3> x = unwrap(Chains::from_molecules(melt.molecules), melt.positions, melt.box);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT(norm2(x[k] - expected[k]), 1e-22) << "bead " << k;
}

TEST(Melt, WalksAreIdealAtLargeDistance) {
  MeltParams params = small_melt();
  params.chains = 400;
  params.beads_per_chain = 100;
  const Melt melt = make_melt(params);
  const std::vector<Vec3> x = whole(melt);
  double sum = 0;
  for (std::size_t chain = 0; chain < 400; ++chain) sum += norm2(x[100 * chain + 99] - x[100 * chain]);
  // Bond angles with cos > cos_min uniform: <cos> = (1 + cos_min)/2, <R^2> = b^2 N C with the freely rotating
  // chain's C.
  const double cos_min =
      params.min_distance_13 * params.min_distance_13 / (2 * params.bond * params.bond) - 1;
  const double cosine = (1 + cos_min) / 2;
  const double bonds = 99;
  const double expected = params.bond * params.bond *
                          (bonds * (1 + cosine) / (1 - cosine) -
                           2 * cosine * (1 - std::pow(cosine, bonds)) / ((1 - cosine) * (1 - cosine)));
  EXPECT_NEAR(sum / 400 / expected, 1, 0.15);  // the mean of 400 has a spread of 4 %
}

TEST(Melt, SameSeedSameBitsOnEveryPlatform) {
  EXPECT_EQ(hash(make_melt(small_melt())), 9813932984633403768U);
  MeltParams other = small_melt();
  other.seed = 2;
  EXPECT_NE(hash(make_melt(other)), hash(make_melt(small_melt())));
}

TEST(Melt, SingleBeadsHaveNoBonds) {
  MeltParams params = small_melt();
  params.chains = 100;
  params.beads_per_chain = 1;
  const Melt melt = make_melt(params);
  EXPECT_EQ(melt.positions.size(), 100U);
  EXPECT_TRUE(melt.bonds.empty());
}

TEST(Melt, RefusesParametersOutOfRange) {
  const auto refused = [](auto change) {
    MeltParams params = small_melt();
    change(params);
    EXPECT_THROW(make_melt(params), InvalidParameter);
  };
  refused([](MeltParams& p) { p.chains = 0; });
  refused([](MeltParams& p) { p.beads_per_chain = -1; });
  refused([](MeltParams& p) { p.chains = p.beads_per_chain = 50000; });
  refused([](MeltParams& p) { p.density = 0; });
  refused([](MeltParams& p) { p.density = std::numeric_limits<double>::quiet_NaN(); });
  refused([](MeltParams& p) { p.density = 1e-320; });
  refused([](MeltParams& p) { p.bond = -0.97; });
  refused([](MeltParams& p) { p.min_distance_13 = 1.94; });
  refused([](MeltParams& p) { p.min_distance_13 = -1; });
  refused([](MeltParams& p) { p.density = 1e3; });
}

TEST(LammpsData, IsReadBackExactly) {
  const Melt melt = make_melt(small_melt());
  std::stringstream file;
  write_lammps_data(file, melt);
  std::string line;
  while (std::getline(file, line) && line != "Atoms # bond") {
  }
  for (std::size_t k = 0; k < melt.positions.size(); ++k) {
    std::size_t id = 0;
    int molecule = 0, type = 0;
    std::string x, y, z;
    std::array<std::int32_t, 3> image{};
    file >> id >> molecule >> type >> x >> y >> z >> image[0] >> image[1] >> image[2];
    ASSERT_TRUE(file) << "atom " << k;
    EXPECT_EQ(id, k + 1);
    EXPECT_EQ(molecule, melt.molecules[k]);
    EXPECT_EQ(type, 1);
    EXPECT_EQ((Vec3{std::stod(x), std::stod(y), std::stod(z)}), melt.positions[k]);
    EXPECT_EQ(image, melt.images[k]);
  }
  std::string heading;
  file >> heading;
  EXPECT_EQ(heading, "Bonds");
  for (std::size_t k = 0; k < melt.bonds.size(); ++k) {
    std::size_t id = 0;
    int type = 0;
    IndexPair bond{};
    file >> id >> type >> bond[0] >> bond[1];
    ASSERT_TRUE(file) << "bond " << k;
    EXPECT_EQ(id, k + 1);
    EXPECT_EQ((IndexPair{bond[0] - 1, bond[1] - 1}), melt.bonds[k]);
  }
  file >> heading;
  EXPECT_TRUE(file.eof());
}

TEST(LammpsData, HeaderOfASmallMelt) {
  MeltParams params;
  params.chains = 125;
  params.beads_per_chain = 1;
  params.density = 1;
  std::ostringstream file;
  write_lammps_data(file, make_melt(params));
  EXPECT_THAT(file.str(),
              testing::StartsWith("bead-spring melt\n\n125 atoms\n0 bonds\n1 atom types\n1 bond types\n\n"
                                  "0 5 xlo xhi\n0 5 ylo yhi\n0 5 zlo zhi\n\nMasses\n\n1 1\n\n"
                                  "Atoms # bond\n\n1 1 1 "));
  EXPECT_THAT(file.str(), testing::Not(testing::HasSubstr("Bonds")));
}

}  // namespace

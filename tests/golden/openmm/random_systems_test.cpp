// SPDX-License-Identifier: MIT
//
// OpenMM's own NonbondedForce by the drop-in in random Systems of all methods, in single precision and in
// double: pairs against all pairs in double, reciprocal space against OpenMM's Reference platform with the
// same numbers. With DCH_DROP_IN_SCENES=190 in the environment there are over 1,000 Systems.
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "drop_in_case.hpp"

namespace OpenMMDCH {
namespace {

/// Of each method.
std::uint64_t count_of_scenes() {
  const char* const asked = std::getenv("DCH_DROP_IN_SCENES");
  return asked ? std::strtoull(asked, nullptr, 10) : 25;
}

/// How far results may be from exact ones: forces of pairs and of reciprocal space relative to their own root
/// mean square, energies to the sum of the absolute energies of all terms: pairs, waves together, and
/// particles with themselves.
struct Bounds {
  double forces, energy;
};

/// A way to have the drop-in compute: a platform, and whether all is in double.
struct Way {
  std::string platform;
  DropInPrecision precision;
  Bounds bounds;
};

constexpr Bounds kSingle{5e-6, 1e-6}, kDouble{1e-10, 1e-11};

Way way_of(const std::string& name) {
  if (name == "CPUInDouble") return {"CPU", DropInPrecision::Double, kDouble};
  return {name, DropInPrecision::Mixed, name == "CPU" ? kSingle : kDouble};
}

class RandomSystemsTest : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Host> drop_in(const OpenMM::System& system) const {
    enableDropIn(way_.precision);
    auto host = std::make_unique<Host>(system, way_.platform);
    disableDropIn();
    return host;
  }
  void expect_equal(const Evaluation& expected, const Evaluation& found, double size,
                    const std::string& what) {
    const Bounds error{force_error(expected, found), std::abs(found.energy - expected.energy) / size};
    EXPECT_LT(error.forces, way_.bounds.forces) << what;
    EXPECT_LT(error.energy, way_.bounds.energy) << what << ", of " << size << " kJ/mol";
    largest_ = {std::max(largest_.forces, error.forces), std::max(largest_.energy, error.energy)};
  }
  /// In the report that --gtest_output=xml asks for.
  void TearDown() override {
    std::ostringstream text;
    text << "forces " << largest_.forces << ", energies " << largest_.energy;
    RecordProperty("largest_errors", text.str());
  }

  Way way_ = way_of(GetParam());

 private:
  Bounds largest_{0, 0};
};

std::vector<std::string> names_of_ways() {
  std::vector<std::string> names = dch_platforms();
  names.emplace_back("CPUInDouble");
  return names;
}

INSTANTIATE_TEST_SUITE_P(Ways, RandomSystemsTest, testing::ValuesIn(names_of_ways()), name_of_platform);

/// The mesh's numbers in a Context, which a platform may have raised, for others to take.
void fix_meshes(Host& host, NonbondedForce& force) {
  double alpha;
  int nx, ny, nz;
  force.getPMEParametersInContext(*host, alpha, nx, ny, nz);
  force.setPMEParameters(alpha, nx, ny, nz);
  if (force.getNonbondedMethod() != NonbondedForce::LJPME) return;
  force.getLJPMEParametersInContext(*host, alpha, nx, ny, nz);
  force.setLJPMEParameters(alpha, nx, ny, nz);
}

/// Energies of particles with themselves, which reciprocal space takes away [kJ/mol].
double energy_of_themselves(const NonbondedForce& force, const OracleSplittings& splittings) {
  double sum = 0;
  for (int i = 0; i < force.getNumParticles(); ++i) {
    double q, sigma, epsilon;
    force.getParticleParameters(i, q, sigma, epsilon);
    const double c = splittings.dispersion > 0 ? dispersion_coefficient(sigma, epsilon) : 0;
    sum += kCoulomb * splittings.charges / std::sqrt(M_PI) * q * q;
    sum += std::pow(splittings.dispersion, 6) / 12 * c * c;
  }
  return sum;
}

TEST_P(RandomSystemsTest, EqualAllPairsAndTheReferenceOfLatticeSums) {
  for (const auto method :
       {NonbondedForce::NoCutoff, NonbondedForce::CutoffNonPeriodic, NonbondedForce::CutoffPeriodic,
        NonbondedForce::Ewald, NonbondedForce::PME, NonbondedForce::LJPME})
    for (std::uint64_t seed = 1; seed <= count_of_scenes(); ++seed) {
      const std::unique_ptr<RandomSystem> made = random_system(method, seed);
      if (method == NonbondedForce::Ewald && is_skewed(*made)) continue;
      const std::string what = "method " + std::to_string(method) + ", seed " + std::to_string(seed);
      const std::unique_ptr<Host> host = drop_in(made->system);
      ASSERT_EQ(nonbondedStatus(**host).at(0).direct, "DCH");
      (*host)->setPositions(made->positions);
      const Vec3* const box = made->force->usesPeriodicBoundaryConditions() ? made->box : nullptr;
      const NonbondedForce oracle = with_offsets_added(*made->force);
      const OracleSplittings splittings = splittings_of(*host);
      const Evaluation pairs = all_pairs(oracle, made->positions, box, splittings);
      if (method <= NonbondedForce::CutoffPeriodic) {
        expect_equal(pairs, host->evaluate(1 << 0), pairs.size, what);
        continue;
      }
      if (method != NonbondedForce::Ewald) fix_meshes(*host, *made->force);
      Host reference(made->system, "Reference");
      reference->setPositions(made->positions);
      const Evaluation waves = reference.evaluate(1 << 1);
      const double themselves = energy_of_themselves(oracle, splittings);
      const double size = pairs.size + themselves + std::abs(waves.energy + themselves);
      expect_equal(pairs, host->evaluate(1 << 0), size, what + ", pairs");
      expect_equal(waves, host->evaluate(1 << 1), size, what + ", reciprocal space");
    }
}

}  // namespace
}  // namespace OpenMMDCH

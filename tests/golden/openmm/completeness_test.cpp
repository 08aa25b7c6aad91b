// SPDX-License-Identifier: MIT
//
// No pair is missing in skewed boxes of any size, wherever particles stand: in boxes that are small against
// the cutoff OpenMM's own lists miss some.
#include <algorithm>

#include "all_pairs_oracle.hpp"

namespace OpenMMDCH {
namespace {

struct Cell {
  std::string name;
  Vec3 box[3];  ///< of width 1 at the narrowest along x, y and z
};

/// With edges of length L: rhombic dodecahedra are narrowest along z, L / sqrt(2); truncated octahedra too,
/// L sqrt(6) / 3.
std::vector<Cell> cells() {
  const double root2 = std::sqrt(2.0), root6 = std::sqrt(6.0);
  Cell dodecahedron{"rhombic dodecahedron", {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, root2 / 2)}};
  Cell octahedron{"truncated octahedron",
                  {Vec3(1, 0, 0), Vec3(1.0 / 3, 2 * root2 / 3, 0), Vec3(-1.0 / 3, root2 / 3, root6 / 3)}};
  for (Vec3& v : dodecahedron.box) v *= root2;
  for (Vec3& v : octahedron.box) v *= 3 / root6;
  return {dodecahedron, octahedron};
}

/// Particles at random places, some of them where lists go wrong easily. No two images are closer than that,
/// and none so near the cutoff that it takes double precision to tell whether they interact.
std::vector<Vec3> scatter(const Vec3* box, int n, double closest, double cutoff, std::uint64_t seed) {
  dch::scenes::Random random(seed);
  std::vector<Vec3> positions{Vec3(-1e-17, -1e-17, -1e-17), Vec3(box[0][0], 0.5 * box[1][1], -1e-17),
                              box[0] * 0.5 + box[1] * (1 - 1e-16) + box[2] * 0.5};
  const auto fits_beside = [&](const Vec3& p, const Vec3& other) {
    Vec3 d = p - other;
    for (int axis = 2; axis >= 0; --axis) d -= box[axis] * std::floor(d[axis] / box[axis][axis] + 0.5);
    for (int n_image = 0; n_image < 27; ++n_image) {
      const Vec3 e =
          d + box[0] * (n_image % 3 - 1) + box[1] * (n_image / 3 % 3 - 1) + box[2] * (n_image / 9 - 1);
      const double r = std::sqrt(e.dot(e));
      if (r < closest || std::abs(r - cutoff) < 1e-5 * cutoff) return false;
    }
    return true;
  };
  const auto fits = [&](const Vec3& p) {
    return std::all_of(positions.begin(), positions.end(),
                       [&](const Vec3& other) { return fits_beside(p, other); });
  };
  for (int trial = 0; trial < 100 * n && static_cast<int>(positions.size()) < n; ++trial) {
    Vec3 p = box[0] * random.uniform() + box[1] * random.uniform() + box[2] * random.uniform();
    if (random.below(10) == 0) p[static_cast<int>(random.below(3))] = -1e-17;
    if (fits(p)) positions.push_back(p);
  }
  for (std::size_t i = 3; i < positions.size(); i += 5) {  // far outside
    const auto cells_away = [&] { return static_cast<double>(random.below(21)) - 10; };
    positions[i] += box[0] * cells_away() + box[1] * cells_away() + box[2] * cells_away();
  }
  return positions;
}

class CompletenessTest : public OnPlatform {};
DCH_ON_EACH_PLATFORM(CompletenessTest);

TEST_P(CompletenessTest, ForcesAreThoseOfAllPairs) {
  // 1e-10 in double; in single precision 1e-4, where one missing pair would show as 1e-2.
  const double allowed = GetParam() == "Reference" ? 1e-10 : 1e-4;
  for (const Cell& cell : cells()) {
    for (const double height : {2.02, 2.3, 3.0, 4.0, 6.0}) {
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Case gas;
        const double cutoff = 1;
        const Vec3 box[3] = {cell.box[0] * height, cell.box[1] * height, cell.box[2] * height};
        for (const Vec3& p : scatter(box, height < 4 ? 120 : 300, 0.3, cutoff, seed))
          gas.add(gas.positions.size() % 2 == 0 ? 0.5 : -0.5, 0.3, 1, p);
        gas.set_box(box[0], box[1], box[2]);
        gas.set_method(DCHNonbondedForce::CutoffPeriodic, cutoff);
        gas.force->setReactionFieldDielectric(1);  // forces of charges are far from 0 at the cutoff
        gas.force->setUseDispersionCorrection(false);
        const std::string what =
            cell.name + ", height " + std::to_string(height) + ", seed " + std::to_string(seed);
        const Evaluation expected = all_pairs(*gas.force, gas.positions, box),
                         found = evaluate(gas, GetParam());
        ASSERT_LT(force_error(expected, found), allowed) << what;
        expect_near(expected.energy, found.energy, allowed, what);
      }
    }
  }
}

}  // namespace
}  // namespace OpenMMDCH

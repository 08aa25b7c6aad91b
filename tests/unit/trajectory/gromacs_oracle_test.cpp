// SPDX-License-Identifier: MIT
// XTC, TRR and GRO frame by frame and bit by bit as libgromacs reads them: the files of tests/data, and
// generated ones that libgromacs writes.
#include "gromacs_oracle.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "frames/cell.hpp"
#include "random.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using Position = std::array<float, 3>;

Vec3 widened(const Position& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// Single precision, as libgromacs has it: files in double precision and text hold more digits.
Vec3 rounded(Vec3 p) {
  return widened({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
}

Box box_of(const GromacsFrame& frame) {
  if (!frame.has_box) return Box::none();
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) cell.edges[k] = widened(frame.box[k]);
  return cell.box();
}

bool same_bits(Vec3 a, Vec3 b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::bit_cast<std::uint64_t>(a[axis]) != std::bit_cast<std::uint64_t>(b[axis])) return false;
  }
  return true;
}

/// Returns the number of frames compared.
std::size_t expect_as_gromacs(const std::string& path, bool single_precision = true) {
  const std::vector<GromacsFrame> expected = read_by_gromacs(path);
  const std::vector<Frame> frames = read_all(path);
  EXPECT_EQ(frames.size(), expected.size()) << path;
  if (frames.size() != expected.size()) return 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const auto& positions = frames[k].positions;
    EXPECT_EQ(frames[k].step, expected[k].step) << path << " frame " << k;
    EXPECT_EQ(static_cast<float>(frames[k].time.value_or(0)), expected[k].time) << path << " frame " << k;
    if (single_precision) {
      EXPECT_EQ(frames[k].box, box_of(expected[k])) << path << " frame " << k;
    }
    EXPECT_EQ(positions.size(), expected[k].positions.size()) << path << " frame " << k;
    if (positions.size() != expected[k].positions.size()) return k;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec3 ours = single_precision ? positions[i] : rounded(positions[i]);
      EXPECT_TRUE(same_bits(ours, widened(expected[k].positions[i])))
          << path << " frame " << k << " atom " << i << ": " << ours.x << " " << ours.y << " " << ours.z;
      if (testing::Test::HasFailure()) return k;
    }
  }
  return frames.size();
}

TEST(GromacsOracle, ReadsTheSameFromTheFilesOfTheData) {
  EXPECT_EQ(expect_as_gromacs(data_path("water.trr")), 100u);
  EXPECT_EQ(expect_as_gromacs(data_path("ubiquitin.trr")), 2u);
  EXPECT_EQ(expect_as_gromacs(data_path("cell_shapes.trr")), 3u);
  EXPECT_EQ(expect_as_gromacs(data_path("cell_shapes.xtc")), 3u);
}

using Scene = std::function<Position(std::size_t atom, scenes::Random& random)>;

Position uniform(scenes::Random& random, float low, float high) {
  const auto draw = [&] { return static_cast<float>(random.uniform(low, high)); };
  return {draw(), draw(), draw()};
}

/// Molecules of `size` atoms, which lie within `spread` of the first: runs of small steps.
Scene molecules(std::size_t size, float spread, float edge) {
  return [=, first = Position{}](std::size_t atom, scenes::Random& random) mutable {
    if (atom % size == 0) return first = uniform(random, 0, edge);
    Position near = uniform(random, -spread, spread);
    for (std::size_t axis = 0; axis < 3; ++axis) near[axis] += first[axis];
    return near;
  };
}

struct Case {
  const char* name;
  Scene scene;
  float precision;
};

std::vector<Case> cases() {
  const auto gas = [](float low, float high) {
    return [=](std::size_t, scenes::Random& random) { return uniform(random, low, high); };
  };
  return {
      {"gas", gas(0, 5), 1000},
      {"water", molecules(3, 0.1f, 5), 1000},
      {"long molecules", molecules(40, 0.2f, 20), 1000},
      {"chain", molecules(1000, 0.05f, 3), 1000},
      {"negative", gas(-7, -2), 1000},
      {"one place", gas(1, 1.0000001f), 1000},
      {"a line",
       [](std::size_t k, scenes::Random&) {
         return Position{static_cast<float>(k) * 0.01f, 2, -3};
       },
       1000},
      {"coarse", molecules(3, 0.1f, 5), 10},
      {"fine", molecules(3, 0.1f, 5), 100000},
      {"numbers above 24 bits, one after the other", gas(-1000, 1000), 10000},
      {"packed numbers above 64 bits", gas(-4, 4), 1000000},
      {"almost 2^30 steps", molecules(3, 0.1f, 1000), 1000000},
      {"far away", gas(2000000, 2000001), 1000},
      {"an odd precision", molecules(3, 0.1f, 5), 1234.567f},
      {"wide steps", molecules(3, 3.0f, 4000), 1000},
      {"steps of all sizes",
       [](std::size_t k, scenes::Random& random) {
         const float spread = std::ldexp(0.002f, static_cast<int>(k / 50 % 22));
         return uniform(random, -spread, spread);
       },
       1000},
  };
}

GromacsFrame make_frame(const Case& a_case, std::size_t atoms, std::int64_t k, scenes::Random& random) {
  GromacsFrame frame;
  frame.step = 1000 * k;
  frame.time = 0.1f * static_cast<float>(k);
  frame.precision = a_case.precision;
  frame.box = k % 2 == 0 ? std::array<Position, 3>{{{5, 0, 0}, {0, 6, 0}, {0, 0, 7}}}
                         : std::array<Position, 3>{{{5, 0, 0}, {1.5f, 6, 0}, {-2, 2.25f, 7}}};
  Scene scene = a_case.scene;
  for (std::size_t atom = 0; atom < atoms; ++atom) frame.positions.push_back(scene(atom, random));
  return frame;
}

TEST(GromacsOracle, ReadsTheSameFromGeneratedFiles) {
  constexpr std::uint64_t kSeed = 20261123;
  RecordProperty("seed", std::to_string(kSeed));
  scenes::Random random(kSeed);
  const ScratchFolder folder;
  std::size_t frames = 0;
  for (const Case& a_case : cases()) {
    for (const std::size_t atoms : {1, 2, 3, 8, 9, 10, 11, 12, 13, 31, 100, 1001, 5000}) {
      SCOPED_TRACE(std::string(a_case.name) + ", " + std::to_string(atoms) + " atoms");
      std::vector<GromacsFrame> written;
      for (std::int64_t k = 0; k < 3; ++k) written.push_back(make_frame(a_case, atoms, k, random));
      write_by_gromacs(folder.path("test.xtc"), written);
      frames += expect_as_gromacs(folder.path("test.xtc"));
      written[1].has_velocities = true;
      write_by_gromacs(folder.path("test.trr"), written);
      frames += expect_as_gromacs(folder.path("test.trr"));
      if (HasFailure()) return;
    }
  }
  EXPECT_EQ(frames, 2u * 3 * 13 * 16);
}

TEST(GromacsOracle, ReadsTheSameNumbersOfGro) {
  scenes::Random random(7);
  const ScratchFolder folder;
  std::string text;
  for (int k = 0; k < 3; ++k) {
    text += "frame, t= " + std::to_string(0.25 * k) + " step= " + std::to_string(50 * k) + "\n  200\n";
    for (int atom = 0; atom < 200; ++atom) {
      char line[128];
      const int width = 8 + k, digits = 3 + k;
      const auto draw = [&] { return random.uniform(-99, 99); };
      std::snprintf(line, sizeof line, "%5dSOL  %5s%5d%*.*f%*.*f%*.*f\n", atom, "OW", atom, width, digits,
                    draw(), width, digits, draw(), width, digits, draw());
      text += line;
    }
    text += k == 1 ? " 5.5 6.25 7 0 0 1.5 0 -2.25 2.5\n" : "   5.50000   6.25000   7.00000\n";
  }
  EXPECT_EQ(expect_as_gromacs(folder.write("test.gro", text), false), 3u);
}

}  // namespace
}  // namespace dch::trajectory::test

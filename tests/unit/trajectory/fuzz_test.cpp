// SPDX-License-Identifier: MIT
// Files with damaged bytes: whatever comes out, it is frames or a FileError, never a crash or an endless
// loop. Any other exception, and any sanitizer report, fails the test.
#include <gtest/gtest.h>

#include <dch/trajectory/topology.hpp>

#include "effort.hpp"
#include "frames/cell.hpp"
#include "random.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"
#include "small_files.hpp"

namespace dch::trajectory::test {
namespace {

/// One to four damages: a flipped bit, another byte, bytes left out, bytes said twice.
std::string damaged(std::string bytes, scenes::Random& random) {
  for (std::size_t k = 1 + random.below(4); k > 0 && !bytes.empty(); --k) {
    const std::size_t at = random.below(bytes.size()), length = 1 + random.below(8);
    switch (random.below(4)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      default:
        bytes.insert(at, bytes.substr(at, length));
        break;
    }
  }
  return bytes;
}

void check_frames(const std::string& path) try {
  const auto reader = open_trajectory(path);
  for (Frame frame; reader->read(frame);) {
    ASSERT_EQ(frame.ids.size(), frame.positions.size());
    for (const Vec3 p : frame.positions) ASSERT_TRUE(is_valid_position(p));
  }
} catch (const FileError&) {
  // An error is a fine answer to a damaged file.
}

TEST(Fuzz, DamagedTrajectoriesGiveFramesOrErrors) {
  const ScratchFolder folder;
  constexpr std::uint64_t kSeed = 20240607;
  RecordProperty("seed", std::to_string(kSeed));
  scenes::Random random(kSeed);
  for (const SmallFile& file : small_files(folder)) {
    for (int k = 0; k < effort(1000); ++k) {
      SCOPED_TRACE(file.name + " case " + std::to_string(k) + " seed " + std::to_string(kSeed));
      check_frames(folder.write(file.name, damaged(file.bytes, random)));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Fuzz, DamagedTopologiesGiveBondsOrErrors) {
  const ScratchFolder folder;
  constexpr std::uint64_t kSeed = 20240608;
  scenes::Random random(kSeed);
  const std::vector<std::int64_t> ids{1, 2, 3, 5, 10, 11, 12};
  const std::pair<const char*, std::string> files[] = {
      {"test.bonds", "1 2 # comment\n10 5\n11 12\n"},
      {"test.chains", "1 2 5-3\nring 10-12 # closed\n"},
      {"test.data",
       "title\n\n7 atoms\n2 bonds\n\nAtoms\n\n1 1 0 0 0\n\nBonds # x\n\n1 1 10 2\n2 1 5 3\n\nAngles\n"}};
  for (const auto& [name, text] : files) {
    for (int k = 0; k < effort(3000); ++k) {
      SCOPED_TRACE(std::string(name) + " case " + std::to_string(k) + " seed " + std::to_string(kSeed));
      const std::string path = folder.write(name, damaged(text, random));
      try {
        for (const auto& [a, b] : read_topology(path, ids).bonds) {
          ASSERT_TRUE(a != b && a >= 0 && b >= 0 && a < 7 && b < 7);
        }
      } catch (const FileError&) {
        continue;
      }
    }
  }
}

}  // namespace
}  // namespace dch::trajectory::test

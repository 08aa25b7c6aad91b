// SPDX-License-Identifier: MIT
//
// A file that memory did not suffice for is refused, and read whole by the next reader.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <dch/trajectory/reader.hpp>

#include "sweep.hpp"

namespace dch::faults {
namespace {

using trajectory::Frame;

/// What is told of a file, bit for bit.
struct Content {
  long frames = 0;
  std::vector<Vec3> positions;
  std::vector<Vec3> corners;

  void add(const Frame& frame) {
    ++frames;
    positions.insert(positions.end(), frame.positions.begin(), frame.positions.end());
    for (int axis = 0; axis < 3; ++axis) corners.push_back(frame.box.vector(axis));
  }
  friend bool operator==(const Content& a, const Content& b) {
    return a.frames == b.frames && a.positions == b.positions && a.corners == b.corners;
  }
};

Content content_of(const std::string& path, const std::string& format) {
  const auto reader = trajectory::open_trajectory(path, format);
  Content content;
  for (Frame frame; reader->read(frame);) content.add(frame);
  return content;
}

void sweep_reading(const std::string& path, const std::string& format, long least_failures) {
  const Content expected = content_of(path, format);
  ASSERT_GT(expected.frames, 0);
  expect_sound(sweep([] { return Content(); }, [&](Content& content) { content = content_of(path, format); },
                     [&](const Content& content, Ending ending) -> std::string {
                       if (ending == Ending::returned && !(content == expected))
                         return "the frames are others";
                       return content_of(path, format) == expected ? "" : "the next reader sees other frames";
                     }),
               least_failures);
}

std::string data(const std::string& name) { return std::string(DCH_TEST_DATA "/") + name; }
std::string corpus(const std::string& name) { return std::string(DCH_TEST_CORPUS "/") + name; }

TEST(TrajectoryFaults, Xtc) { sweep_reading(data("cell_shapes.xtc"), "xtc", 10); }
TEST(TrajectoryFaults, Trr) { sweep_reading(data("cell_shapes.trr"), "trr", 10); }
TEST(TrajectoryFaults, Gro) { sweep_reading(corpus("gro/atoms-3"), "gro", 10); }
TEST(TrajectoryFaults, Dcd) { sweep_reading(corpus("dcd/atoms-12"), "dcd", 10); }
TEST(TrajectoryFaults, LammpsDump) {
  for (const char* const name : {"general", "plain", "triclinic", "unscaled"})
    sweep_reading(corpus(std::string("dump/") + name), "dump", 10);
}

}  // namespace
}  // namespace dch::faults

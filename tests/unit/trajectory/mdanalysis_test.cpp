// SPDX-License-Identifier: MIT
// Golden: frames as MDAnalysis reads them, from the files in tests/data and from H5MD files that the writer
// makes.
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

#include <dch/trajectory/writer.hpp>

#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

/// The frames for the script: number of atoms, origin and three edges of the box, positions, all as doubles.
void write_raw(const std::string& path, const std::vector<Frame>& frames) {
  std::ofstream out(path, std::ios::binary);
  const auto put = [&](double value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto put_vector = [&](Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) put(v[axis]);
  };
  for (const Frame& frame : frames) {
    put(static_cast<double>(frame.positions.size()));
    put_vector(frame.box.origin());
    for (int axis = 0; axis < 3; ++axis) put_vector(frame.box.vector(axis));
    for (const Vec3 p : frame.positions) put_vector(p);
  }
}

void compare(const std::string& path, const std::vector<Frame>& frames) {
  const ScratchFolder folder;
  write_raw(folder.path("frames"), frames);
  const std::string command = std::string(DCH_PYTHON) + " " + DCH_TEST_SCRIPTS +
                              "/compare_with_mdanalysis.py " + path + " " + folder.path("frames") + " > " +
                              folder.path("output") + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << path << "\n" << read_file(folder.path("output"));
}

class MDAnalysisReads : public testing::TestWithParam<const char*> {};

TEST_P(MDAnalysisReads, TheSameFrames) {
  const std::string name = GetParam();
  if (name == "nacl.lammpstrj") return;  // has no ids: MDAnalysis takes xs, the first column, for them
  const ScratchFolder folder;            // MDAnalysis leaves index files beside what it reads
  const std::string copy = folder.write(name, read_file(data_path(name)));
  compare(copy, read_all(copy));
}

TEST(MDAnalysisWrites, XtcFilesThatAreReadBitByBit) {
  for (const char* atoms : {"7", "10", "500"}) {
    const ScratchFolder folder;
    const std::string path = folder.path("test.xtc");
    const std::string command =
        std::string(DCH_PYTHON) + " " + DCH_TEST_SCRIPTS + "/write_xtc.py " + path + " " + atoms;
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto frames = read_all(path);
    EXPECT_EQ(frames.size(), 16u);
    compare(path, frames);
  }
}

TEST_P(MDAnalysisReads, TheH5mdFileWrittenFromThem) {
  const ScratchFolder folder;
  const auto reader = open_trajectory(data_path(GetParam()));
  const auto frames = read_all(*reader);
  for (const char* name : {"test.h5md", "test.h5"}) {
    const auto writer = create_trajectory(folder.path(name), reader->length_unit());
    for (const Frame& frame : frames) writer->write(frame);
    writer->close();
    compare(folder.path(name), frames);
  }
}

INSTANTIATE_TEST_SUITE_P(Data, MDAnalysisReads,
                         testing::Values("polymer.lammpstrj", "nacl.lammpstrj", "water.trr", "ubiquitin.trr",
                                         "cell_shapes.trr", "cell_shapes.xtc", "withpbc.dcd", "nopbc.dcd",
                                         "triclinic-namd.dcd"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = c == '.' || c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace dch::trajectory::test

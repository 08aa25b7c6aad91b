// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstdint>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "reading.hpp"
#include "scratch_folder.hpp"
#include "trr_file.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class GromacsReader : public testing::Test {
 protected:
  std::string error(const std::string& name, const std::string& bytes) {
    return try_to_read(folder_.write(name, bytes)).error;
  }

  ScratchFolder folder_;
};

TEST_F(GromacsReader, ReadsTrr) {
  const auto reader = open_trajectory(data_path("water.trr"));
  EXPECT_EQ(reader->format(), "GROMACS TRR");
  EXPECT_EQ(reader->length_unit(), "nm");
  const auto frames = read_all(*reader);
  ASSERT_EQ(frames.size(), 100u);
  EXPECT_EQ(frames[0].positions.size(), 297u);
  EXPECT_EQ(frames[2].step, 2);
  EXPECT_NEAR(frames[2].time.value(), 0.2, 1e-7);
  EXPECT_EQ(frames[0].box.kind(), Box::Kind::orthorhombic);
  EXPECT_NEAR(frames[0].box.min_height(), 1.5, 1e-15);
  EXPECT_EQ(frames[0].ids.back(), 297);

  const auto ubiquitin = read_all(data_path("ubiquitin.trr"));
  ASSERT_EQ(ubiquitin.size(), 2u);
  EXPECT_EQ(ubiquitin[1].positions.size(), 20455u);
  EXPECT_EQ(ubiquitin[1].step, 25000);
}

TEST_F(GromacsReader, ReadsBoxesOfAllShapes) {
  for (const char* name : {"cell_shapes.trr", "cell_shapes.xtc"}) {
    const auto frames = read_all(data_path(name));
    ASSERT_EQ(frames.size(), 3u) << name;
    for (const Frame& frame : frames) {
      ASSERT_EQ(frame.positions.size(), 10u);
      EXPECT_NEAR(norm2(frame.positions[9] - Vec3{0.9, 9, 90}), 0, 1e-10);
    }
    EXPECT_EQ(frames[0].box.kind(), Box::Kind::orthorhombic);  // its tilts are 1e-16
    EXPECT_EQ(frames[1].box.kind(), Box::Kind::triclinic);
    EXPECT_NEAR(norm2(frames[1].box.vector(2) - Vec3{2.3837, 1.7521, 1.5620}), 0, 1e-6);
    EXPECT_EQ(frames[2].box, Box::none());  // no box in the TRR file, zeros in the XTC file
  }
}

TEST_F(GromacsReader, PassesOverTrrFramesWithoutPositions) {
  TrrFile<float> file;
  file.append_frame(3, 0, {.box = true, .positions = false, .velocities = true});
  file.append_frame(3, 5, {.box = true, .positions = true, .velocities = true}, 1);
  file.append_frame(3, 6, {.box = true, .positions = false, .velocities = true});
  file.append_frame(3, 7, {.box = false, .positions = true}, 2);
  file.append_frame(3, 8, {.box = false, .positions = false, .velocities = true});
  const auto frames = read_all(folder_.write("test.trr", file.bytes()));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].step, 5);
  EXPECT_EQ(frames[0].box, Box::orthorhombic({4, 4, 4}));
  EXPECT_THAT(frames[0].positions,
              ElementsAre(Vec3{1, 1.125, 1.25}, Vec3{1.375, 1.5, 1.625}, Vec3{1.75, 1.875, 2}));
  EXPECT_EQ(frames[1].step, 7);
  EXPECT_EQ(frames[1].box, Box::none());
  EXPECT_EQ(frames[1].positions[0], (Vec3{2, 2.125, 2.25}));

  TrrFile<float> none;
  none.append_frame(3, 0, {.box = true, .positions = false, .velocities = true});
  EXPECT_THAT(error("none.trr", none.bytes()), HasSubstr("no frame with positions"));
}

TEST_F(GromacsReader, ReadsTrrInDoublePrecision) {
  TrrFile<double> file;
  file.append_frame(4, 1, {}, 3);
  file.append_frame(4, 2, {}, 4);
  const auto frames = read_all(folder_.write("test.trr", file.bytes()));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].positions[3], (Vec3{4 + 9 / 8.0, 4 + 10 / 8.0, 4 + 11 / 8.0}));
}

TEST_F(GromacsReader, RefusesBrokenTrr) {
  TrrFile<float> file;
  file.append_frame(3, 0, {});
  const std::string good = file.bytes();
  const std::size_t second = good.size();
  TrrFile<float> other_count = file;
  other_count.append_frame(4, 1, {});
  EXPECT_THAT(error("test.trr", other_count.bytes()),
              AllOf(HasSubstr("test.trr: frame 1, byte " + std::to_string(second)),
                    HasSubstr("4 atoms, the first frame 3")));
  TrrFile<float> not_a_number = file;
  not_a_number.append_frame(3, 1, {}, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(error("test.trr", not_a_number.bytes()),
              AllOf(HasSubstr("frame 1, byte"), HasSubstr("not finite")));
  std::string magic = good;
  magic[3] = 7;
  EXPECT_THAT(error("test.trr", magic), AllOf(HasSubstr("frame 0, byte 0"), HasSubstr("magic number 1993")));
  std::string version = good;
  version[12] = 'X';
  EXPECT_THAT(error("test.trr", version), HasSubstr("expected 'GMX_trn_file', found 'XMX_trn_file'"));
  std::string sizes = good;
  sizes[24 + 4 * 7 + 3] = 40;  // bytes of positions
  EXPECT_THAT(error("test.trr", sizes), HasSubstr("has 40 bytes, expected 0 or 36 for 3 atoms"));
  std::string box = good;
  box.replace(84, 4, std::string(4, '\0'));  // the first of the box's nine numbers
  EXPECT_THAT(error("test.trr", box), HasSubstr("frame 0, byte 0"));
}

TEST_F(GromacsReader, RefusesBrokenXtc) {
  const std::string good = read_file(data_path("cell_shapes.xtc"));
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string broken = good;
    broken.replace(at, bytes.size(), bytes);
    return error("test.xtc", broken);
  };
  using std::string;
  EXPECT_THAT(with(0, string("\0\0\x07\xe7", 4)),
              HasSubstr("it is truncated"));  // the size has 64 bits there
  EXPECT_THAT(with(3, "x"), AllOf(HasSubstr("frame 0, byte 0"), HasSubstr("magic number 1995")));
  EXPECT_THAT(with(4, string("\xff\xff\xff\xff", 4)), HasSubstr("number of atoms above 0, found -1"));
  EXPECT_THAT(with(7, "\x0b"), HasSubstr("expected 11 coordinates as in the header, found 10"));
  EXPECT_THAT(with(12, string("\x7f\xc0\0\0", 4)), HasSubstr("the time holds nan"));
  EXPECT_THAT(with(0x38, string("\0\0\0\0", 4)), HasSubstr("precision above 0"));
  EXPECT_THAT(with(0x54, string("\0\0\0\x4a", 4)),
              HasSubstr("index of the step size from 9 to 73, found 74"));
  EXPECT_THAT(with(0x58, string("\0\0\0\x01", 4)), HasSubstr("1 bytes cannot hold"));
  EXPECT_THAT(with(0x58, string("\0\0\0\x08", 4)),
              AllOf(HasSubstr("frame 0, byte 92"), HasSubstr("coordinates end early")));
  EXPECT_THAT(with(0x9b, "\xff"), AllOf(HasSubstr("frame 1, byte 152"), HasSubstr("magic number")));
}

TEST_F(GromacsReader, ReadsXtcWithLongSizes) {
  const std::string good = read_file(data_path("cell_shapes.xtc"));
  std::string file;
  for (std::size_t frame = 0; frame < good.size(); frame += good.size() / 3) {
    std::string bytes = good.substr(frame, good.size() / 3);
    bytes.replace(2, 2, "\x07\xe7");           // magic 2023
    bytes.insert(0x58, std::string(4, '\0'));  // the upper half of the size
    file += bytes;
  }
  const auto frames = read_all(folder_.write("test.xtc", file)),
             same = read_all(data_path("cell_shapes.xtc"));
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(frames[k].positions, same[k].positions);
}

TEST_F(GromacsReader, ReadsXtcOfAFewAtoms) {
  // Up to nine atoms are not compressed: the number of atoms and the coordinates follow the box.
  const auto integer = [](std::int32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const auto real = [&](float value) { return integer(std::bit_cast<std::int32_t>(value)); };
  std::string frame = integer(1995) + integer(2) + integer(30) + real(0.5f);
  for (const float value : {4.f, 0.f, 0.f, 0.f, 5.f, 0.f, 0.f, 0.f, 6.f}) frame += real(value);
  frame += integer(2);
  for (const float value : {1.f, 2.f, 3.f, 4.f, 5.f, 6.f}) frame += real(value);
  const auto frames = read_all(folder_.write("test.xtc", frame + frame));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].step, 30);
  EXPECT_EQ(frames[1].box, Box::orthorhombic({4, 5, 6}));
  EXPECT_THAT(frames[1].positions, ElementsAre(Vec3{1, 2, 3}, Vec3{4, 5, 6}));
  frame.replace(frame.size() - 4, 4, real(std::numeric_limits<float>::infinity()));
  EXPECT_THAT(error("test.xtc", frame), AllOf(HasSubstr("frame 0, byte 76"), HasSubstr("holds inf")));
}

constexpr const char* kGro =
    "Two waters, t= 1.5 step= 3\n"
    "    2\n"
    "    1WATER  OW1    1   0.126   1.624   1.679  0.1227 -0.0580  0.0434\n"
    "    1WATER  HW2    2   0.190   1.661   1.747  0.8085  0.3191 -0.7791\n"
    "   1.82060   2.82060   3.82060\n";

TEST_F(GromacsReader, ReadsGro) {
  const std::string second =
      "More digits and a triclinic box\n 2\n"
      "    1WATER  OW1    1   0.12600   1.62400  -1.67900\n"
      "    1WATER  HW2    2   0.19000   1.66100   1.74700\n"
      " 2 3 4 0 0 0.5 0 0.25 -0.75\n";
  const auto frames = read_all(folder_.write("test.gro", kGro + second + "\n"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].step, 3);
  EXPECT_NEAR(frames[0].time.value(), 1.5, 1e-6);
  EXPECT_EQ(frames[0].box.kind(), Box::Kind::orthorhombic);
  EXPECT_NEAR(frames[0].box.vector(2).z, 3.8206, 1e-6);
  EXPECT_EQ(frames[0].positions[1], (Vec3{0.190, 1.661, 1.747}));
  EXPECT_EQ(frames[1].positions[0], (Vec3{0.126, 1.624, -1.679}));
  EXPECT_EQ(frames[1].box, Box::triclinic({2, 0, 0}, {0.5, 3, 0}, {0.25, -0.75, 4}));
}

TEST_F(GromacsReader, RefusesBrokenGro) {
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string broken = kGro;
    broken.replace(broken.find(from), from.size(), to);
    return error("test.gro", broken);
  };
  EXPECT_THAT(with("    2\n", "    x\n"), AllOf(HasSubstr("frame 0, line 2"), HasSubstr("number of atoms")));
  EXPECT_THAT(with("    2\n", "    3\n"),
              AllOf(HasSubstr("frame 0, line 5"), HasSubstr("expected the coordinate z")));
  EXPECT_THAT(with("    2\n", "    9\n"), HasSubstr("line 5"));
  EXPECT_THAT(with("0.190", "0.1x0"),
              AllOf(HasSubstr("frame 0, line 4"), HasSubstr("coordinate x in the columns 21 to 28")));
  EXPECT_THAT(with("1.747", "  nan"), AllOf(HasSubstr("line 4"), HasSubstr("coordinate z")));
  EXPECT_THAT(with("   2.82060", ""),
              AllOf(HasSubstr("line 5"), HasSubstr("3 or 9 numbers for the box, found 2")));
  EXPECT_THAT(with("2.82060", "0.00000"),
              AllOf(HasSubstr("frame 0, line 5"), HasSubstr("edge along y is 0 long")));
  EXPECT_THAT(with("   0.126   1.624   1.679  0.1227 -0.0580  0.0434", "   1 2 3"),
              HasSubstr("three coordinates"));
  EXPECT_THAT(
      error("test.gro", std::string(kGro) + "title\n    1\n" + std::string(kGro).substr(33, 69) + " 1 1 1\n"),
      AllOf(HasSubstr("frame 1, line 6"), HasSubstr("1 atoms, the first frame 2")));
}

}  // namespace
}  // namespace dch::trajectory::test

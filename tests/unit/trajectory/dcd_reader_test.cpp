// SPDX-License-Identifier: MIT
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "dcd_file.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class DcdReader : public testing::Test {
 protected:
  std::vector<Frame> read(const DcdFile& file) { return read_all(folder_.write("test.dcd", file.bytes())); }
  std::string error(const std::string& bytes) { return try_to_read(folder_.write("test.dcd", bytes)).error; }

  ScratchFolder folder_;
};

constexpr double kAkma = 0.0488882129;

TEST_F(DcdReader, ReadsNamdFiles) {
  const auto with_box = read_all(data_path("withpbc.dcd"));
  ASSERT_EQ(with_box.size(), 146u);
  EXPECT_EQ(with_box[0].positions.size(), 364u);
  EXPECT_EQ(with_box[0].box, Box::orthorhombic({100, 100, 100}));
  EXPECT_EQ(with_box[2].step, 30);
  EXPECT_NEAR(with_box[2].time.value(), 0.06, 1e-6);

  const auto without_box = read_all(data_path("nopbc.dcd"));
  ASSERT_EQ(without_box.size(), 40u);
  EXPECT_EQ(without_box[0].positions.size(), 401u);
  EXPECT_EQ(without_box[0].box, Box::none());
  EXPECT_EQ(without_box[0].ids[400], 401);

  const auto triclinic = read_all(data_path("triclinic-namd.dcd"));
  ASSERT_EQ(triclinic.size(), 1u);
  EXPECT_EQ(triclinic[0].positions.size(), 9999u);
  EXPECT_EQ(triclinic[0].box.kind(), Box::Kind::triclinic);
  EXPECT_NEAR(std::sqrt(norm2(triclinic[0].box.vector(1))), 89.44, 5e-3);
}

TEST_F(DcdReader, ReadsEitherByteOrder) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    DcdFile file(order);
    file.append_header();
    for (const float shift : {0.0f, 10.0f}) {
      file.append_coordinates({1 + shift, 2 + shift});
      file.append_coordinates({3 + shift, 4 + shift});
      file.append_coordinates({5 + shift, 6 + shift});
    }
    const auto frames = read(file);  // the header says one frame: the size of the file counts
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_THAT(frames[0].positions, ElementsAre(Vec3{1, 3, 5}, Vec3{2, 4, 6}));
    EXPECT_THAT(frames[1].positions, ElementsAre(Vec3{11, 13, 15}, Vec3{12, 14, 16}));
    EXPECT_EQ(frames[1].step, 110);
    EXPECT_DOUBLE_EQ(frames[1].time.value(), 110 * 0.5 * kAkma);
  }
}

TEST_F(DcdReader, ReadsXplorFiles) {
  DcdFile file;
  file.version = 0;
  file.interval = 0;
  file.append_header();
  for (int axis = 0; axis < 3; ++axis) file.append_coordinates({1, 2});
  const auto frames = read(file);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].box, Box::none());
  EXPECT_EQ(frames[0].step, 0);
  EXPECT_FALSE(frames[0].time);
}

TEST_F(DcdReader, ReadsFixedAtomsAndTheFourthDimension) {
  DcdFile file;
  file.atoms = 3;
  file.free_atoms = {3, 1};
  file.has_fourth_dimension = true;
  file.append_header();
  for (const float x : {1.0f, 2.0f, 3.0f}) file.append_coordinates({x, x + 10, x + 20});
  file.append_coordinates({0, 0, 0});
  for (const float x : {4.0f, 5.0f, 6.0f}) file.append_coordinates({x + 20, x});
  file.append_coordinates({0, 0});
  const auto frames = read(file);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_THAT(frames[1].positions, ElementsAre(Vec3{4, 5, 6}, Vec3{11, 12, 13}, Vec3{24, 25, 26}));
}

TEST_F(DcdReader, ReadsCellsInAllTheirForms) {
  const auto box_of = [this](const std::array<double, 6>& cell) {
    DcdFile file;
    file.has_cell = true;
    file.append_header();
    file.append_cell(cell);
    for (int axis = 0; axis < 3; ++axis) file.append_coordinates({1, 2});
    return read(file).at(0).box;
  };
  EXPECT_EQ(box_of({10, 90, 20, 90, 90, 30}), Box::orthorhombic({10, 20, 30}));
  EXPECT_EQ(box_of({10, 0, 20, 0, 0, 30}), Box::orthorhombic({10, 20, 30}));  // cosines, or a diagonal matrix
  EXPECT_EQ(box_of({0, 90, 0, 90, 90, 0}), Box::none());
  EXPECT_EQ(box_of({0, 0, 0, 0, 0, 0}), Box::none());
  const Box degrees = box_of({10, 60, 20, 90, 90, 30});
  EXPECT_NEAR(degrees.vector(1).x, 10, 1e-13);  // gamma lies between a and b: 20 cos 60
  const Box cosines = box_of({10, 0.5, 20, 0, 0, 30});
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(norm2(cosines.vector(k) - degrees.vector(k)), 0, 1e-25);
  // CHARMM's symmetric matrix xx, xy, yy, xz, yz, zz
  EXPECT_EQ(box_of({10, -2, 20, 1, 3, 30}), Box::triclinic({10, -2, 1}, {-2, 20, 3}, {1, 3, 30}));
}

TEST_F(DcdReader, RefusesBadHeaders) {
  EXPECT_THAT(error("not a DCD file at all, but long enough"),
              AllOf(HasSubstr("byte 0"), HasSubstr("'CORD'")));
  DcdFile velocities;
  velocities.kind = "VELD";
  velocities.append_header();
  EXPECT_THAT(error(velocities.bytes()), HasSubstr("velocities"));
  EXPECT_THAT(error(std::string("\x54\0\0\0\0\0\0\0CORD", 12)), HasSubstr("64-bit"));
  DcdFile no_atoms;
  no_atoms.atoms = -1;
  no_atoms.append_header();
  EXPECT_THAT(error(no_atoms.bytes()), HasSubstr("number of atoms above 0, found -1"));
  DcdFile bad_list;
  bad_list.free_atoms = {3};
  bad_list.append_header();
  EXPECT_THAT(error(bad_list.bytes()), HasSubstr("names atom 3 of 2"));
  DcdFile no_frames;
  no_frames.append_header();
  EXPECT_THAT(error(no_frames.bytes()), HasSubstr("no frame"));
}

TEST_F(DcdReader, RefusesBadFrames) {
  DcdFile file;
  file.append_header();
  const auto header_size = file.bytes().size();
  file.append_coordinates({1, 2});
  file.append_coordinates({1, std::numeric_limits<float>::quiet_NaN()});
  file.append_coordinates({1, 2});
  EXPECT_THAT(error(file.bytes()), AllOf(HasSubstr("frame 0, byte " + std::to_string(header_size + 16) + ":"),
                                         HasSubstr("the y coordinate of atom 2 is nan")));
  DcdFile other_count;
  other_count.append_header();
  for (const auto& values : {std::vector<float>{1, 2}, {1, 2}, {1, 2}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}) {
    other_count.append_coordinates(values);
  }
  EXPECT_THAT(error(other_count.bytes()),
              AllOf(HasSubstr("frame 1"), HasSubstr("of 8 bytes, found a length of 12")));
  DcdFile too_many;  // more than memory holds: the length of the record has to be looked at first
  too_many.atoms = 2000000000;
  too_many.append_header();
  too_many.append_coordinates({1, 2});
  EXPECT_THAT(error(too_many.bytes()), HasSubstr("of 8000000000 bytes, found a length of 8"));
  for (const std::array<double, 6>& cell :
       {std::array<double, 6>{10, 90, 0, 90, 90, 30}, {-10, 90, 20, 90, 90, 30}, {10, 130, 20, 60, 60, 30}}) {
    DcdFile bad_cell;
    bad_cell.has_cell = true;
    bad_cell.append_header();
    bad_cell.append_cell(cell);
    EXPECT_THAT(error(bad_cell.bytes()), AllOf(HasSubstr("frame 0, byte"), HasSubstr("is no cell")));
  }
  std::string mismatch = file.bytes().substr(0, header_size + 16);
  mismatch[header_size + 12] = 9;
  EXPECT_THAT(error(mismatch), HasSubstr("begins with the length 8 but ends with 9"));
}

}  // namespace
}  // namespace dch::trajectory::test

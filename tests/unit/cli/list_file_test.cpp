// SPDX-License-Identifier: MIT
#include "report/list_file.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <dch/trajectory/file_error.hpp>

#include "expect_error.hpp"
#include "hdf5_read.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

using testing::ElementsAre;

class ListFileTest : public TemporaryFolder {
 protected:
  static ListFileHeader header() {
    ListFileHeader header;
    header.source = "a.xtc";
    header.unit = "nm";
    header.engine = "dch";
    header.exclusions = "none";
    header.cutoff = 1.5;
    header.skin = 0.25;
    header.kind = ListKind::half;
    header.most_atoms = 3;
    return header;
  }

  static trajectory::Frame frame_of(std::int64_t step, std::vector<std::int64_t> ids = {11, 12, 13}) {
    trajectory::Frame frame;
    frame.step = step;
    frame.ids = std::move(ids);
    return frame;
  }

  static double read_number(hid_t file, const char* name) {
    double value = 0;
    const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), 0);
    H5Aclose(attribute);
    return value;
  }
};

TEST_F(ListFileTest, HoldsRowsOfEveryFrameAndSharesThoseOfKeptLists) {
  const NeighborList two_pairs{ListKind::half, {0, 2, 2, 2}, {1, 2}};
  const NeighborList no_pair{ListKind::half, {0, 0, 0, 0}, {}};
  const NeighborList one_pair{ListKind::half, {0, 0, 1, 1}, {2}};
  ListFile lists(path("lists.h5"), header());
  lists.append(0, frame_of(100), two_pairs, true);
  lists.append(2, frame_of(200), two_pairs, false);
  lists.append(4, frame_of(300), no_pair, true);
  lists.append(6, frame_of(400), one_pair, true);
  EXPECT_FALSE(std::filesystem::exists(path("lists.h5")));
  lists.commit();
  EXPECT_EQ(files(), 1u);

  const hid_t file = H5Fopen(path("lists.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_THAT(read_integers(file, "ids"), ElementsAre(11, 12, 13, 11, 12, 13, 11, 12, 13, 11, 12, 13));
  EXPECT_THAT(read_integers(file, "frame"), ElementsAre(0, 2, 4, 6));
  EXPECT_THAT(read_integers(file, "step"), ElementsAre(100, 200, 300, 400));
  EXPECT_THAT(read_integers(file, "j"), ElementsAre(1, 2, 2));
  EXPECT_THAT(read_integers(file, "first"), ElementsAre(0, 2, 2, 2, 0, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3));
  EXPECT_EQ(read_number(file, "cutoff"), 1.5);
  EXPECT_EQ(read_number(file, "skin"), 0.25);
  H5Fclose(file);
}

TEST_F(ListFileTest, FillsFramesOfFewerAtomsWithEmptyRows) {
  ListFile lists(path("lists.h5"), header());
  lists.append(0, frame_of(0, {11, 13}), {ListKind::half, {0, 1, 1}, {1}}, true);
  lists.append(1, frame_of(1), {ListKind::half, {0, 0, 1, 1}, {2}}, true);
  lists.commit();
  const hid_t file = H5Fopen(path("lists.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_THAT(read_integers(file, "ids"), ElementsAre(11, 13, -1, 11, 12, 13));
  EXPECT_THAT(read_integers(file, "first"), ElementsAre(0, 1, 1, 1, 1, 1, 2, 2));
  H5Fclose(file);
}

TEST_F(ListFileTest, TakesNoAtoms) {
  ListFileHeader empty = header();
  empty.most_atoms = 0;
  ListFile lists(path("lists.h5"), empty);
  lists.append(0, trajectory::Frame(), NeighborList(), true);
  lists.commit();
  EXPECT_TRUE(std::filesystem::exists(path("lists.h5")));
}

TEST_F(ListFileTest, LeavesNothingBehindIfNotCompleted) {
  {
    ListFile lists(path("lists.h5"), header());
    lists.append(0, frame_of(0), {ListKind::half, {0, 1, 1, 1}, {1}}, true);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(ListFileTest, RefusesAFolderThatIsNotThere) {
  expect_error<trajectory::FileError>([&] { ListFile(path("no/lists.h5"), header()); }, {"no/lists.h5"});
}

}  // namespace
}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include <csignal>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

#include <dch/trajectory/writer.hpp>

#include "reading.hpp"
#include "sample_frames.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<Box> kBoxes{
    Box::none(), Box::orthorhombic({10, 20, 30}),
    Box::orthorhombic({10, 20, 30}, {true, false, true}, {-5, 0.5, 1.25}),
    Box::triclinic({10, 0, 0}, {-3, 20, 0}, {2, 5, 30}, {true, true, false}, {1, 2, 3}),
    Box::triclinic({1, 10, 0}, {-10, 1, 0.5}, {0, 2, 30}, {true, true, true}, {1, 2, 3})};

TEST(LammpsDumpWriter, WritesWhatTheReaderReads) {
  const ScratchFolder folder;
  for (std::size_t b = 0; b < kBoxes.size(); ++b) {
    const std::string path = folder.path("test.dump");
    const auto writer = create_trajectory(path, "the dump's unit");
    for (int k = 0; k < 3; ++k) writer->write(sample_frame(k, kBoxes[b]));
    writer->close();
    const auto frames = read_all(path);
    ASSERT_EQ(frames.size(), 3u);
    for (int k = 0; k < 3; ++k) expect_equal(frames[static_cast<std::size_t>(k)], sample_frame(k, kBoxes[b]));
  }
}

TEST(LammpsDumpWriter, WritesUnitsThatLammpsHas) {
  const ScratchFolder folder;
  for (const char* unit : {"nm", "Angstrom", "sigma", "furlong"}) {
    const std::string path = folder.path("test.lammpstrj");
    const auto writer = create_trajectory(path, unit);
    writer->write(sample_frame(3, Box::none()));
    writer->close();
    const auto reader = open_trajectory(path);
    EXPECT_EQ(reader->length_unit(), std::string(unit) == "furlong" ? "the dump's unit" : unit);
    EXPECT_NEAR(read_all(*reader).at(0).time.value(), 0.3, 1e-15);
  }
}

TEST(LammpsDumpWriter, WritesOnlyTheColumnsThatAreThere) {
  const ScratchFolder folder;
  Frame frame;
  frame.positions = {{1, 2, 3}};
  frame.ids = {1};
  const auto writer = create_trajectory(folder.path("test.dump"), "");
  writer->write(frame);
  writer->close();
  EXPECT_EQ(read_file(folder.path("test.dump")),
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 0\n0 0\n0 0\n"
            "ITEM: ATOMS id x y z\n1 1 2 3\n");
}

class AnyWriter : public testing::TestWithParam<const char*> {
 protected:
  std::string path() const { return folder_.path(std::string("test") + GetParam()); }
  ScratchFolder folder_;
};

TEST_P(AnyWriter, LeavesNothingUnlessClosed) {
  {
    const auto writer = create_trajectory(path(), "nm");
    writer->write(sample_frame(0, Box::none()));
    EXPECT_FALSE(std::filesystem::exists(path()));
    EXPECT_EQ(folder_.files(), 1u);
  }
  EXPECT_EQ(folder_.files(), 0u);
}

TEST_P(AnyWriter, KeepsAnOlderFileUntilTheNewOneIsComplete) {
  folder_.write(std::string("test") + GetParam(), "old");
  {
    const auto writer = create_trajectory(path(), "nm");
    writer->write(sample_frame(0, Box::none()));
  }
  EXPECT_EQ(read_file(path()), "old");
  const auto writer = create_trajectory(path(), "nm");
  writer->write(sample_frame(0, Box::none()));
  writer->close();
  EXPECT_EQ(read_all(path()).size(), 1u);
  EXPECT_EQ(folder_.files(), 1u);
}

TEST_P(AnyWriter, RefusesFramesThatAreNone) {
  const auto refuses = [&](const auto& change, const char* reason) {
    Frame frame = sample_frame(0, Box::none());
    change(frame);
    const auto writer = create_trajectory(path(), "nm");
    EXPECT_THAT([&] { writer->write(frame); },
                ThrowsMessage<FileError>(
                    AllOf(HasSubstr(path() + ": frame 0 cannot be written"), HasSubstr(reason))));
  };
  refuses([](Frame& f) { f.positions[1].y = std::numeric_limits<double>::quiet_NaN(); },
          "id 3 has a coordinate");
  refuses([](Frame& f) { f.ids.pop_back(); }, "2 ids");
  refuses([](Frame& f) { f.types.pop_back(); }, "2 types");
  refuses([](Frame& f) { f.molecules.pop_back(); }, "2 molecule numbers");
  refuses([](Frame& f) { f.images.pop_back(); }, "2 images");
  EXPECT_EQ(folder_.files(), 0u);
}

TEST_P(AnyWriter, RefusesPlacesThatCannotBeWrittenTo) {
  EXPECT_THAT([&] { create_trajectory(folder_.path("no/such") + GetParam(), "nm"); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("no/such"), HasSubstr("No such file or directory"))));
  std::filesystem::create_directory(path());
  EXPECT_THAT([&] { create_trajectory(path(), "nm"); }, ThrowsMessage<FileError>(HasSubstr("is a folder")));
}

/// Lets files grow to so many bytes only, which stands for a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_P(AnyWriter, SaysSoIfTheDiskIsFull) {
  Frame frame = sample_frame(0, Box::none());
  frame.positions.resize(5000);
  frame.ids.resize(5000);
  frame.types.clear();
  frame.molecules.clear();
  frame.images.clear();
  for (std::size_t k = 0; k < 5000; ++k) {
    frame.ids[k] = static_cast<std::int64_t>(k);
    frame.positions[k] = {0.123456789, 0.1 * static_cast<double>(k), 1.0 / 3};
  }
  for (const rlim_t limit : {rlim_t{500}, rlim_t{20000}, rlim_t{150000}, rlim_t{400000}}) {
    const FileSizeLimit full(limit);
    EXPECT_THAT(
        [&] {
          const auto writer = create_trajectory(path(), "nm");
          for (int k = 0; k < 10; ++k) writer->write(frame);
          writer->close();
        },
        ThrowsMessage<FileError>(HasSubstr("cannot be written")));
    EXPECT_EQ(folder_.files(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, AnyWriter, testing::Values(".dump", ".h5"),
                         [](const auto& test) { return std::string(test.param + 1); });

TEST(CreateTrajectory, NamesTheEndingsItKnows) {
  EXPECT_THAT(
      [] { create_trajectory("test.xtc", "nm"); },
      ThrowsMessage<FileError>(AllOf(HasSubstr("test.xtc: "), HasSubstr(".h5 .h5md .lammpstrj .dump"))));
}

}  // namespace
}  // namespace dch::trajectory::test

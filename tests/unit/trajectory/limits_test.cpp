// SPDX-License-Identifier: MIT
// Small files that would grow without end, and files that are none.
#include <ctime>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <dch/trajectory/topology.hpp>

#include "reading.hpp"
#include "scratch_folder.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string write_gzip(const ScratchFolder& folder, const std::string& name, const std::string& head,
                       const std::string& line, int times) {
  const gzFile file = gzopen(folder.path(name).c_str(), "wb");
  gzwrite(file, head.data(), static_cast<unsigned>(head.size()));
  for (int k = 0; k < times; ++k) gzwrite(file, line.data(), static_cast<unsigned>(line.size()));
  gzclose(file);
  return folder.path(name);
}

constexpr const char* kHead =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2000000000\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\n"
    "ITEM: ATOMS x y z\n";

std::string lines_of_atoms() {
  std::string lines;
  while (lines.size() < 60000) lines += "1 2 3\n";
  return lines;
}

TEST(Limits, OfAFrameOfCompressedText) {
  const ScratchFolder folder;
  ReadLimits limits;
  limits.expanded = 10'000'000;
  const std::string path = write_gzip(folder, "bomb.dump.gz", kHead, lines_of_atoms(), 400);
  const auto reader = open_trajectory(path, limits);
  Frame frame;
  EXPECT_THAT([&] { reader->read(frame); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("bomb.dump.gz: frame 0"), HasSubstr("10000000 bytes"),
                                             HasSubstr("--max-expanded"))));
  EXPECT_LT(frame.positions.capacity(), 2u * (10'000'000 + 4'000'000) / 6);
  EXPECT_THAT(try_to_read(path).error, HasSubstr("truncated"));  // the default lets it pass
}

TEST(Limits, AreThoseOfAFrameAndNotOfTheFile) {
  const ScratchFolder folder;
  std::string text(kHead);
  text.replace(text.find("2000000000"), 10, "10000");
  text += lines_of_atoms();
  ReadLimits limits;
  limits.expanded = 100'000;
  const auto reader = open_trajectory(write_gzip(folder, "long.dump.gz", "", text, 200), limits);
  EXPECT_EQ(read_all(*reader).size(), 200u);
}

TEST(Limits, OfALine) {
  const ScratchFolder folder;
  const std::string path = write_gzip(folder, "line.dump.gz", "", std::string(1 << 20, ' '), 64);
  EXPECT_THAT(try_to_read(path).error, HasSubstr("longer than 1 MiB"));
}

TEST(Limits, ManyColumnsTakeNoTime) {
  const ScratchFolder folder;
  std::string text =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS x "
      "y z";
  std::string atom = "1 2 3";
  for (int k = 0; k < 150000; ++k) text += " " + std::to_string(k), atom += " 0";
  const auto begin = std::clock();
  EXPECT_EQ(try_to_read(folder.write("wide.dump", text + "\n" + atom + "\n")).frames, 1u);
  EXPECT_LT(std::clock() - begin, 10 * CLOCKS_PER_SEC);  // name by name with every other it took minutes
}

TEST(Limits, OfCompressedTopologies) {
  const ScratchFolder folder;
  ReadLimits limits;
  limits.expanded = 1'000'000;
  const std::string path = write_gzip(folder, "bomb.bonds", "1 2\n", std::string(60000, '\n'), 200);
  EXPECT_THAT(
      [&] {
        read_topology(path, {1, 2}, limits);
      },
      ThrowsMessage<FileError>(AllOf(HasSubstr("bomb.bonds: line"), HasSubstr("1000000 bytes: "))));
  EXPECT_EQ(read_topology(path, {1, 2}).bonds.size(), 1u);
}

TEST(Limits, OfRangesInChains) {
  const ScratchFolder folder;
  std::vector<std::int64_t> ids(1000);
  for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<std::int64_t>(k) + 1;
  std::string text;
  for (int k = 0; k < 8; ++k) text += "1-1000 999-2\n";
  EXPECT_NO_THROW(read_topology(folder.write("often.chains", text), ids));
  text += "1-1000\n";
  EXPECT_THAT([&] { read_topology(folder.write("bomb.chains", text), ids); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("bomb.chains: line 9"), HasSubstr("16001 atoms"),
                                             HasSubstr("16 times the trajectory's 1000"))));
  EXPECT_THAT([&] { read_topology(folder.write("far.chains", "1-2000000000\n"), ids); },
              ThrowsMessage<FileError>(HasSubstr("no atom with the id 1001")));
}

TEST(Limits, APipeIsNoFile) {
  const ScratchFolder folder;
  for (const char* name : {"pipe.h5", "pipe.xtc", "pipe.dump", "pipe.dcd"}) {
    ASSERT_EQ(::mkfifo(folder.path(name).c_str(), 0600), 0);
    EXPECT_THAT(try_to_read(folder.path(name)).error, HasSubstr("is not a regular file")) << name;
  }
  EXPECT_THROW(read_topology("/dev/zero", {1}), FileError);
}

}  // namespace
}  // namespace dch::trajectory::test

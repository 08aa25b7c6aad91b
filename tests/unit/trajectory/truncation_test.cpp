// SPDX-License-Identifier: MIT
// A file cut short ends in an error, unless it has been cut exactly where a frame ends.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effort.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"
#include "small_files.hpp"

namespace dch::trajectory::test {
namespace {

using testing::HasSubstr;

void check_cut(const ScratchFolder& folder, const SmallFile& file, std::size_t size) {
  const std::string path = folder.write(file.name, file.bytes.substr(0, size));
  const Outcome outcome = try_to_read(path);
  const auto end = std::find(file.frame_ends.begin(), file.frame_ends.end(), size);
  const bool whole = size > 0 && end != file.frame_ends.end();
  if (file.frames_come_last) {
    const auto ends_before = std::upper_bound(file.frame_ends.begin(), file.frame_ends.end(), size);
    EXPECT_LE(outcome.frames, static_cast<std::size_t>(ends_before - file.frame_ends.begin()));
  }
  if (whole) {
    EXPECT_EQ(outcome.error, "") << file.name << " cut to " << size << " bytes";
    EXPECT_EQ(outcome.frames, static_cast<std::size_t>(end - file.frame_ends.begin()) + 1);
  } else {
    EXPECT_THAT(outcome.error, HasSubstr(path)) << file.name << " cut to " << size << " bytes";
  }
}

TEST(Truncation, IsFoundAtEveryByteOfSmallFiles) {
  const ScratchFolder folder;
  for (const SmallFile& file : small_files(folder)) {
    // HDF5 files are large for what they hold: at most 2,000 cuts spread evenly, and all of the last 256.
    const std::size_t stride =
        std::max<std::size_t>(1, file.bytes.size() / static_cast<std::size_t>(effort(2000)));
    for (std::size_t size = 0; size <= file.bytes.size(); size += stride) check_cut(folder, file, size);
    const std::size_t tail = std::min<std::size_t>(256, file.bytes.size());
    for (std::size_t size = file.bytes.size() - tail; size <= file.bytes.size(); ++size)
      check_cut(folder, file, size);
  }
}

TEST(Truncation, IsFoundInRealFiles) {
  const ScratchFolder folder;
  const auto check = [&](const char* name, std::size_t header, std::size_t frame) {
    SmallFile file{name, read_file(data_path(name)), {}};
    for (std::size_t at = header + frame; at <= file.bytes.size(); at += frame) file.frame_ends.push_back(at);
    ASSERT_EQ(file.frame_ends.back(), file.bytes.size()) << name;
    constexpr std::size_t kPrime = 7919;
    for (std::size_t size = 0; size < file.bytes.size(); size += kPrime) check_cut(folder, file, size);
    for (const std::size_t end : {file.frame_ends.front(), file.frame_ends.back()}) {
      for (std::size_t size = end - 5; size <= std::min(end + 5, file.bytes.size()); ++size)
        check_cut(folder, file, size);
    }
  };
  check("water.trr", 0, 3684);
  check("withpbc.dcd", 276, 4448);
  check("nopbc.dcd", 276, 4836);
  check("ubiquitin.trr", 0, 736500);
}

TEST(Truncation, IsFoundInARealDump) {
  const ScratchFolder folder;
  SmallFile file{"nacl.lammpstrj", read_file(data_path("nacl.lammpstrj")), {}};
  for (std::size_t at = 1; (at = file.bytes.find("ITEM: TIMESTEP", at)) != std::string::npos; ++at) {
    file.frame_ends.push_back(at);
  }
  file.frame_ends.push_back(file.bytes.size());
  ASSERT_EQ(file.frame_ends.size(), 6u);
  constexpr std::size_t kPrime = 499;
  for (std::size_t size = 0; size < file.bytes.size(); size += kPrime) check_cut(folder, file, size);
  for (std::size_t size = file.bytes.size() - 99; size <= file.bytes.size(); ++size)
    check_cut(folder, file, size);
}

}  // namespace
}  // namespace dch::trajectory::test

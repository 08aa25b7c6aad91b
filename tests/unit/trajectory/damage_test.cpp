// SPDX-License-Identifier: MIT
// Every byte of small files of every format is damaged in turn: what comes out is frames within limits or a
// FileError, never anything else. Decoders get their bytes in blocks of memory of just that size, so that
// the address sanitizer sees every access beyond.
#include <gtest/gtest.h>
#include <memory>

#include "effort.hpp"
#include "frames/cell.hpp"
#include "gromacs/trr_decoder.hpp"
#include "gromacs/xtc_decoder.hpp"
#include "gromacs_oracle.hpp"
#include "random.hpp"
#include "reading.hpp"
#include "scratch_folder.hpp"
#include "small_files.hpp"
#include "trr_file.hpp"

namespace dch::trajectory::test {
namespace {

struct Count {
  std::size_t frames = 0;
  std::size_t errors = 0;
  std::size_t sum() const { return frames + errors; }
};

/// Decodes bytes that may be anything.
void decode(const FrameDecoder& decoder, const std::string& bytes, Count& count) {
  const std::unique_ptr<unsigned char[]> exact(new unsigned char[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), exact.get());
  const Bytes all(exact.get(), bytes.size());
  Frame frame;
  try {
    const FrameExtent extent = decoder.measure(all.first(std::min(all.size(), FrameDecoder::kLongestHeader)));
    ASSERT_GT(extent.total, 0);
    ASSERT_LE(extent.needed, extent.total);
    if (extent.total > static_cast<std::int64_t>(bytes.size())) throw BrokenFrame(0, "truncated");
    if (extent.has_positions) {
      ASSERT_LE(extent.atoms, FrameDecoder::kMaxAtomsPerByte * extent.needed);
      decoder.decode(all.first(static_cast<std::size_t>(extent.needed)), frame);
      ASSERT_EQ(static_cast<std::int64_t>(frame.positions.size()), extent.atoms);
    }
    ++count.frames;
  } catch (const BrokenFrame&) {
    ++count.errors;
  } catch (const InvalidBox&) {
    ++count.errors;
  }
  ASSERT_LE(static_cast<std::int64_t>(frame.positions.capacity()),
            FrameDecoder::kMaxAtomsPerByte * static_cast<std::int64_t>(bytes.size()));
}

/// All 255 other values of every byte, every cut, and every number of the header with its extremes.
Count damage_everywhere(const FrameDecoder& decoder, const std::string& good) {
  Count count;
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bytes = good;
    for (int change = 1; change < 256; ++change) {
      bytes[at] = static_cast<char>(good[at] ^ change);
      decode(decoder, bytes, count);
    }
    decode(decoder, good.substr(0, at), count);
  }
  for (std::size_t at = 0; at + 4 <= std::min(good.size(), FrameDecoder::kLongestHeader); at += 4) {
    for (const char* extreme :
         {"\x7f\xff\xff\xff", "\x80\0\0\0", "\xff\xff\xff\xff", "\x7f\x80\0\0", "\0\0\0\0", "\0\0\0\1"}) {
      std::string bytes = good;
      bytes.replace(at, 4, extreme, 4);
      decode(decoder, bytes, count);
    }
  }
  return count;
}

GromacsFrame gromacs_frame(std::size_t atoms, float edge, float precision) {
  scenes::Random random(5);
  GromacsFrame frame;
  frame.box = {{{edge, 0, 0}, {0, edge, 0}, {0, 0, edge}}};
  frame.precision = precision;
  for (std::size_t k = 0; k < atoms; ++k) {
    const float from = k % 3 == 0 ? 0 : frame.positions[k - k % 3][0], range = k % 3 == 0 ? edge : 0.1f;
    const auto draw = [&] { return from + range * static_cast<float>(random.uniform()); };
    frame.positions.push_back({draw(), draw(), draw()});
  }
  return frame;
}

TEST(Damage, OfXtcGivesFramesOrErrors) {
  const ScratchFolder folder;
  const XtcDecoder decoder;
  Count count;
  std::size_t expected = 0;
  // Atoms as they are; packed into 64 bits and fewer; into more; one coordinate after the other.
  for (const auto& [atoms, edge, precision] : {std::tuple{5, 5.f, 1e3f}, std::tuple{48, 5.f, 1e3f},
                                               std::tuple{48, 12.f, 1e6f}, std::tuple{48, 500.f, 1e5f}}) {
    write_by_gromacs(folder.path("test.xtc"),
                     {gromacs_frame(static_cast<std::size_t>(atoms), edge, precision)});
    const std::string good = read_file(folder.path("test.xtc"));
    const Count damaged = damage_everywhere(decoder, good);
    expected += 256 * good.size() + 6 * (std::min(good.size(), FrameDecoder::kLongestHeader) / 4);
    count.frames += damaged.frames;
    count.errors += damaged.errors;
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(count.sum(), expected);
  EXPECT_GT(count.sum(), 250000u);
  EXPECT_GT(count.errors, count.sum() / 5);
  EXPECT_GT(count.frames, count.sum() / 5);  // a coordinate may be another, and a step, and a time
  std::printf("XTC: %zu damaged files, %zu errors\n", count.sum(), count.errors);
}

TEST(Damage, OfTrrGivesFramesOrErrors) {
  const TrrDecoder decoder;
  TrrFile<float> single;
  single.append_frame(5, 1, {.box = true, .positions = true, .velocities = true});
  TrrFile<double> real;
  real.append_frame(5, 1, {.box = true, .positions = true, .velocities = true});
  for (const std::string& good : {single.bytes(), real.bytes()}) {
    const Count count = damage_everywhere(decoder, good);
    if (HasFatalFailure()) return;
    EXPECT_EQ(count.sum(), 256 * good.size() + 6 * (std::min(good.size(), FrameDecoder::kLongestHeader) / 4));
    EXPECT_GT(count.errors, count.sum() / 10);
    std::printf("TRR: %zu damaged files, %zu errors\n", count.sum(), count.errors);
  }
}

void check_frames(const std::string& path, std::size_t file_size, Count& count) try {
  const auto reader = open_trajectory(path);
  for (Frame frame; reader->read(frame);) {
    ASSERT_EQ(frame.ids.size(), frame.positions.size());
    ASSERT_LE(frame.positions.size(), 1032 * file_size);  // as much as anything can be packed
    for (const Vec3 p : frame.positions) ASSERT_TRUE(is_valid_position(p));
  }
  ++count.frames;
} catch (const FileError& error) {
  ASSERT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  ++count.errors;
}

TEST(Damage, OfEveryFormatGivesFramesOrErrors) {
  const ScratchFolder folder;
  for (const SmallFile& file : small_files(folder)) {
    Count count;
    // HDF5 files are large for what they hold, and each takes a process.
    const auto most = static_cast<std::size_t>(file.name == "test.h5" ? effort(100) : effort(1500));
    const std::size_t stride = std::max<std::size_t>(1, file.bytes.size() / most);
    std::size_t places = 0;
    for (std::size_t at = 0; at < file.bytes.size(); at += stride, ++places) {
      for (const int change : {0x01, 0x80, 0xff}) {
        SCOPED_TRACE(file.name + " byte " + std::to_string(at) + " change " + std::to_string(change));
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ change);
        check_frames(folder.write(file.name, bytes), bytes.size(), count);
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_EQ(count.sum(), 3 * places);
    EXPECT_GT(count.errors, count.sum() / 100) << file.name;
    std::printf("%s: %zu damaged files, %zu errors\n", file.name.c_str(), count.sum(), count.errors);
  }
}

}  // namespace
}  // namespace dch::trajectory::test

// SPDX-License-Identifier: MIT
#include "gromacs/trr_decoder.hpp"

#include <array>
#include <fmt/format.h>
#include <numeric>
#include <string_view>

#include "base/text.hpp"
#include "gromacs/xdr_cursor.hpp"

namespace dch::trajectory {
namespace {

constexpr std::int32_t kTrrMagic = 1993;
constexpr std::string_view kVersion = "GMX_trn_file";

struct TrrHeader {
  enum Block {
    input_record,
    energies,
    box,
    virial,
    pressure,
    topology,
    symbols,
    positions,
    velocities,
    forces,
    blocks
  };
  std::array<std::int64_t, blocks> size{};  ///< of each block, in the file's order [bytes]
  std::int64_t atoms = 0;
  std::int64_t real = 0;  ///< size of a number, 4 or 8 [bytes]
  std::int32_t step = 0;
  double time = 0;

  bool has(Block block) const { return size[block] != 0; }
};

void read_magic(XdrCursor& cursor) {
  const std::int32_t magic = cursor.read_int("the TRR magic number");
  if (magic != kTrrMagic) {
    cursor.fail_here(fmt::format("expected the TRR magic number {}, found {}", kTrrMagic, magic));
  }
  const auto length = static_cast<std::int32_t>(kVersion.size());
  for (const std::int32_t expected : {length + 1, length}) {  // once with the zero that ends it in memory
    const std::int32_t found = cursor.read_int("the length of the version");
    if (found != expected) cursor.fail_here(fmt::format("expected {}, found {}", expected, found));
  }
  const std::string version = cursor.read_text("the version", length);
  if (version != kVersion) cursor.fail_here("expected 'GMX_trn_file', found " + in_quotes(version));
}

/// The first block that is there tells the size of numbers.
std::int64_t real_size(const XdrCursor& cursor, const TrrHeader& header) {
  if (header.has(TrrHeader::box)) return header.size[TrrHeader::box] / 9;
  for (const auto block : {TrrHeader::positions, TrrHeader::velocities, TrrHeader::forces}) {
    if (header.has(block)) return header.size[block] / (3 * header.atoms);
  }
  cursor.fail_here("the frame has neither box nor positions, velocities or forces");
}

void check_sizes(const XdrCursor& cursor, const TrrHeader& header) {
  if (header.real != 4 && header.real != 8) {
    cursor.fail_here(fmt::format("expected numbers of 4 or 8 bytes, found {}", header.real));
  }
  const std::int64_t matrix = 9 * header.real, vectors = 3 * header.atoms * header.real;
  const std::array<std::int64_t, TrrHeader::blocks> expected{0, 0, matrix,  matrix,  matrix,
                                                             0, 0, vectors, vectors, vectors};
  for (std::size_t block = 0; block < expected.size(); ++block) {
    if (header.size[block] == 0 || header.size[block] == expected[block]) continue;
    cursor.fail_here(fmt::format("block {} of the frame has {} bytes, expected 0 or {} for {} atoms", block,
                                 header.size[block], expected[block], header.atoms));
  }
}

TrrHeader read_trr_header(XdrCursor& cursor) {
  read_magic(cursor);
  TrrHeader header;
  for (std::int64_t& size : header.size) size = cursor.read_int("the sizes of the blocks");
  header.atoms = cursor.read_int("the number of atoms");
  if (header.atoms <= 0) {
    cursor.fail_here(fmt::format("expected a number of atoms above 0, found {}", header.atoms));
  }
  header.real = real_size(cursor, header);
  check_sizes(cursor, header);
  header.step = cursor.read_int("the step");
  cursor.read_int("the number of energies");
  header.time = cursor.read_finite_real("the time", header.real);
  cursor.read_finite_real("lambda", header.real);
  return header;
}

}  // namespace

FrameExtent TrrDecoder::measure(Bytes head) const {
  XdrCursor cursor(head);
  const TrrHeader header = read_trr_header(cursor);
  const auto* const begin = header.size.data();
  FrameExtent extent;
  extent.atoms = header.atoms;
  extent.has_positions = header.has(TrrHeader::positions);
  extent.needed = std::accumulate(begin, begin + TrrHeader::velocities, cursor.offset());
  extent.total = std::accumulate(begin, begin + header.size.size(), cursor.offset());
  return extent;
}

void TrrDecoder::decode(Bytes bytes, Frame& frame) const {
  XdrCursor cursor(bytes);
  const TrrHeader header = read_trr_header(cursor);
  frame.step = header.step;
  frame.time = header.time;
  frame.box = header.has(TrrHeader::box) ? cursor.read_cell(header.real).box() : Box::none();
  cursor.take("virial and pressure", header.size[TrrHeader::virial] + header.size[TrrHeader::pressure]);
  XdrCursor positions(cursor.take("the positions", header.size[TrrHeader::positions]));
  frame.positions.resize(static_cast<std::size_t>(header.atoms));
  for (Vec3& position : frame.positions) {
    for (int axis = 0; axis < 3; ++axis) position[axis] = positions.read_real("the positions", header.real);
  }
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "gromacs/xtc_decoder.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "gromacs/xdr_cursor.hpp"
#include "gromacs/xtc_stream.hpp"

namespace dch::trajectory {
namespace {

constexpr std::int32_t kXtcMagic = 1995;
constexpr std::int32_t kMagicOfLargeSystems = 2023;
constexpr std::int64_t kMaxUncompressedAtoms = 9;

struct XtcHeader {
  std::int64_t atoms = 0;
  std::int32_t step = 0;
  double time = 0;
  Cell cell;
  bool has_long_size = false;
  XtcStream stream;       ///< if there are more atoms than kMaxUncompressedAtoms
  std::int64_t data = 0;  ///< bytes in front of the coordinates
  std::int64_t size = 0;  ///< bytes of the coordinates
};

void read_range(XdrCursor& cursor, XtcStream& stream) {
  for (std::int32_t& low : stream.low) low = cursor.read_int("the smallest coordinates");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t low = stream.low[axis], high = cursor.read_int("the largest coordinates");
    if (high < low) {
      cursor.fail_here(fmt::format("the largest coordinate {} lies below the smallest {}", high, low));
    }
    constexpr std::int64_t kMax = 2147483647;
    if (high - low >= kMax) {
      cursor.fail_here(fmt::format("the coordinates {} to {} are further apart than XTC can express, {}", low,
                                   high, kMax - 1));
    }
    stream.size[axis] = static_cast<std::uint32_t>(high - low + 1);
  }
}

void read_stream_header(XdrCursor& cursor, XtcHeader& header) {
  XtcStream& stream = header.stream;
  stream.precision = static_cast<float>(cursor.read_real("the precision"));
  if (!(stream.precision > 0) || !std::isfinite(stream.precision)) {
    cursor.fail_here(fmt::format("expected a precision above 0, found {}", stream.precision));
  }
  read_range(cursor, stream);
  stream.small = cursor.read_int("the index of the step size");
  if (stream.small < kFirstSmall || stream.small > kLastSmall) {
    cursor.fail_here(fmt::format("expected an index of the step size from {} to {}, found {}", kFirstSmall,
                                 kLastSmall, stream.small));
  }
  const char* what = "the size of the compressed coordinates";
  header.size = header.has_long_size ? cursor.read_long(what) : cursor.read_int(what);
  constexpr std::int64_t kMax = std::int64_t{1} << 40;  // far above 2^31 atoms of 3 * 32 bits
  // A position takes a bit and the flag behind it at least.
  if (header.size <= 0 || header.size > kMax || header.atoms > FrameDecoder::kMaxAtomsPerByte * header.size) {
    cursor.fail_here(fmt::format("{} bytes cannot hold the compressed coordinates of {} atoms", header.size,
                                 header.atoms));
  }
}

XtcHeader read_xtc_header(XdrCursor& cursor) {
  XtcHeader header;
  const std::int32_t magic = cursor.read_int("the XTC magic number");
  if (magic != kXtcMagic && magic != kMagicOfLargeSystems) {
    cursor.fail_here(fmt::format("expected the XTC magic number {} or {}, found {}", kXtcMagic,
                                 kMagicOfLargeSystems, magic));
  }
  header.has_long_size = magic == kMagicOfLargeSystems;
  header.atoms = cursor.read_int("the number of atoms");
  if (header.atoms <= 0) {
    cursor.fail_here(fmt::format("expected a number of atoms above 0, found {}", header.atoms));
  }
  header.step = cursor.read_int("the step");
  header.time = cursor.read_finite_real("the time");
  header.cell = cursor.read_cell();
  const std::int32_t again = cursor.read_int("the number of coordinates");
  if (again != header.atoms) {
    cursor.fail_here(fmt::format("expected {} coordinates as in the header, found {}", header.atoms, again));
  }
  if (header.atoms > kMaxUncompressedAtoms) {
    read_stream_header(cursor, header);
  } else {
    header.size = header.atoms * 3 * static_cast<std::int64_t>(sizeof(float));
  }
  header.data = cursor.offset();
  return header;
}

}  // namespace

FrameExtent XtcDecoder::measure(Bytes head) const {
  XdrCursor cursor(head);
  const XtcHeader header = read_xtc_header(cursor);
  FrameExtent extent;
  extent.atoms = header.atoms;
  extent.needed = header.data + header.size;
  extent.total = header.data + (header.size + 3) / 4 * 4;
  return extent;
}

void XtcDecoder::decode(Bytes bytes, Frame& frame) const {
  XdrCursor cursor(bytes);
  const XtcHeader header = read_xtc_header(cursor);
  frame.step = header.step;
  frame.time = header.time;
  frame.box = header.cell.box();
  if (header.atoms <= kMaxUncompressedAtoms) {
    frame.positions.resize(static_cast<std::size_t>(header.atoms));
    for (Vec3& position : frame.positions) position = cursor.read_finite_vector("the coordinates");
    return;
  }
  const Bytes data = cursor.take("the compressed coordinates", header.size);
  frame.positions.resize(static_cast<std::size_t>(header.atoms));
  if (const char* problem = header.stream.decode(data, frame.positions)) {
    throw BrokenFrame(header.data, problem);
  }
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "report/view_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <zlib.h>

namespace dch::cli {
namespace {

constexpr double kSteps = 65535;  // between the ends of the extent

/// Whole numbers, seven bits a byte, the lowest first; a byte that more follow has its highest bit set.
void append_number(std::uint32_t value, std::string& bytes) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(0x80 | (value & 0x7f)));
  bytes.push_back(static_cast<char>(value));
}

void append_step(std::int32_t from, std::int32_t to, std::string& bytes) {
  append_number(static_cast<std::uint32_t>(to - from), bytes);
}

void append_rows(const NeighborList& list, std::string& bytes) {
  for (std::size_t row = 0; row < list.size(); ++row) {
    append_number(static_cast<std::uint32_t>(list.row(row).size()), bytes);
    auto last = static_cast<std::int32_t>(row);
    for (const std::int32_t neighbor : list.row(row)) {
      append_step(last, neighbor, bytes);
      last = neighbor;
    }
  }
}

void append_level(const ViewedLevel& level, bool is_lowest, std::string& bytes) {
  std::int32_t last = 0;
  for (const std::int32_t node : level.nodes) {
    if (is_lowest) break;
    append_step(last, node, bytes);
    last = node;
  }
  for (const std::int32_t parent : level.parents) append_step(-1, parent, bytes);
  if (!is_lowest) append_rows(level.edges, bytes);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  const int status = compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                              reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
  if (status != Z_OK) throw std::bad_alloc();  // the one thing that it may lack
  packed.resize(size);
  return packed;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t byte = 0; byte < 3; ++byte)
      group = group << 8 | (byte < count ? static_cast<unsigned char>(bytes[k + byte]) : 0u);
    for (std::size_t digit = 0; digit < 4; ++digit)
      text.push_back(digit <= count ? kDigits[group >> (18 - 6 * digit) & 0x3f] : '=');
  }
  return text;
}

}  // namespace

ViewedExtent extent_of(const ViewedFrame& frame) {
  ViewedExtent extent;
  if (frame.positions.empty()) return extent;
  extent.low = extent.high = frame.positions.front();
  for (const Vec3& position : frame.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      extent.low[axis] = std::min(extent.low[axis], position[axis]);
      extent.high[axis] = std::max(extent.high[axis], position[axis]);
    }
  }
  return extent;
}

std::string view_stream(const ViewedFrame& frame, const ViewedExtent& extent) {
  std::string bytes;
  for (const Vec3& position : frame.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      const double size = extent.high[axis] - extent.low[axis];
      const double share = size > 0 ? (position[axis] - extent.low[axis]) / size : 0;
      append_number(static_cast<std::uint32_t>(std::lround(kSteps * share)), bytes);
    }
  }
  append_rows(frame.contacts, bytes);
  for (std::size_t i = 0; i < frame.levels.size(); ++i) append_level(frame.levels[i], i == 0, bytes);
  return base64(deflated(bytes));
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "process/frame_channel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "frames/cell.hpp"
#include "process/byte_channel.hpp"

namespace dch::trajectory {
namespace {

/// The parts of a frame whose size does not depend on the number of atoms. Only types of which any bytes are
/// a value: the sender may not be trusted.
struct FrameHead {
  std::int64_t step;
  double time;
  std::uint8_t has_time;
  std::uint8_t has_box;
  std::array<std::uint8_t, 3> periodic;
  std::array<Vec3, 3> edges;
  Vec3 origin;
};
static_assert(std::is_trivially_copyable_v<FrameHead>);

FrameHead head_of(const Frame& frame) {
  FrameHead head{};
  head.step = frame.step;
  head.has_time = frame.time.has_value();
  head.time = frame.time.value_or(0);
  head.has_box = frame.box.kind() != Box::Kind::none;
  for (int axis = 0; axis < 3; ++axis) {
    head.edges[static_cast<std::size_t>(axis)] = frame.box.vector(axis);
    head.periodic[static_cast<std::size_t>(axis)] = frame.box.periodic(axis);
  }
  head.origin = frame.box.origin();
  return head;
}

Box box_of(const FrameHead& head) {
  if (head.has_box == 0) return Box::none();
  Cell cell;
  cell.edges = head.edges;
  cell.origin = head.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) cell.periodic[axis] = head.periodic[axis] != 0;
  return cell.box();
}

}  // namespace

bool FrameSender::send_hello(const std::string& format, const std::string& length_unit) {
  return send_kind(Message::hello) && send_text(format) && send_text(length_unit);
}

bool FrameSender::send_frame(const Frame& frame) {
  const FrameHead head = head_of(frame);
  return send_kind(Message::frame) && send(&head, sizeof head) && send_array(frame.positions) &&
         send_array(frame.ids) && send_array(frame.types) && send_array(frame.molecules) &&
         send_array(frame.images);
}

bool FrameSender::send_end() { return send_kind(Message::end); }

bool FrameSender::send_done() { return send_kind(Message::done); }

bool FrameSender::send_kind(Message kind) { return send(&kind, sizeof kind); }

bool FrameSender::send_error(const std::string& what) { return send_kind(Message::error) && send_text(what); }

bool FrameSender::send(const void* data, std::size_t size) const {
  return send_bytes(descriptor_, data, size);
}

bool FrameSender::send_text(const std::string& text) {
  return send_array(std::vector<char>(text.begin(), text.end()));
}

template <class T>
bool FrameSender::send_array(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto count = static_cast<std::int64_t>(values.size());
  return send(&count, sizeof count) && send(values.data(), values.size() * sizeof(T));
}

bool FrameReceiver::receive_kind(Message& kind) { return receive(&kind, sizeof kind); }

bool FrameReceiver::receive_hello(std::string& format, std::string& length_unit) {
  return receive_text(format) && receive_text(length_unit);
}

bool FrameReceiver::receive_frame(Frame& frame) {
  FrameHead head{};
  if (!receive(&head, sizeof head)) return false;
  frame.step = head.step;
  frame.time.reset();
  if (head.has_time != 0) frame.time = head.time;
  try {
    frame.box = box_of(head);
  } catch (const InvalidBox&) {
    return false;
  }
  return receive_array(frame.positions) && receive_array(frame.ids) && receive_array(frame.types) &&
         receive_array(frame.molecules) && receive_array(frame.images);
}

bool FrameReceiver::receive_text(std::string& text) {
  std::vector<char> characters;
  if (!receive_array(characters)) return false;
  text.assign(characters.begin(), characters.end());
  return true;
}

bool FrameReceiver::receive(void* data, std::size_t size) const {
  return receive_bytes(descriptor_, data, size);
}

template <class T>
bool FrameReceiver::receive_array(std::vector<T>& values) {
  std::int64_t count = 0;
  if (!receive(&count, sizeof count)) return false;
  if (count < 0 || count > std::numeric_limits<std::int32_t>::max()) return false;
  // Memory for what has arrived, and at most as much again or a block.
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  values.clear();
  for (auto missing = static_cast<std::size_t>(count); missing > 0;) {
    const std::size_t had = values.size(), part = std::min(missing, std::max(kBlock, had));
    values.resize(had + part);
    if (!receive(values.data() + had, part * sizeof(T))) return false;
    missing -= part;
  }
  return true;
}

}  // namespace dch::trajectory

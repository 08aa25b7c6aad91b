// SPDX-License-Identifier: MIT
#include "process/forked_reader.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <functional>
#include <new>
#include <system_error>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "base/place.hpp"
#include "frames/cell.hpp"
#include "process/frame_channel.hpp"

namespace dch::trajectory {
namespace {

void send_all_frames(const std::string& path, const ReaderFactory& make_reader, int seconds_per_frame,
                     FrameSender& sender) try {
  ChildProcess::restart_watchdog(seconds_per_frame);
  const std::unique_ptr<TrajectoryReader> reader = make_reader();
  if (!sender.send_hello(reader->format(), reader->length_unit())) return;
  Frame frame;
  while (true) {
    ChildProcess::restart_watchdog(seconds_per_frame);
    ChildProcess::clear_messages();
    if (!reader->read(frame)) break;
    if (!sender.send_frame(frame)) return;
  }
  sender.send_end();
} catch (const FileError& error) {
  sender.send_error(error.what());
} catch (const std::bad_alloc&) {
  sender.send_error(path + ": a frame does not fit into memory");
} catch (const std::exception& error) {
  sender.send_error(path + ": " + error.what());
}

/// A child that a file has got under its control may send anything.
bool is_sound(const Frame& frame) {
  const std::size_t atoms = frame.positions.size();
  const auto fits = [=](std::size_t count) { return count == 0 || count == atoms; };
  return frame.ids.size() == atoms && fits(frame.types.size()) && fits(frame.molecules.size()) &&
         fits(frame.images.size()) &&
         std::adjacent_find(frame.ids.begin(), frame.ids.end(), std::greater_equal<>()) == frame.ids.end() &&
         std::all_of(frame.positions.begin(), frame.positions.end(), is_valid_position);
}

}  // namespace

ForkedReader::ForkedReader(std::string path, ReaderFactory make_reader, ChildBounds bounds)
    : path_(std::move(path)) {
  start(std::move(make_reader), std::move(bounds));
  FrameReceiver receiver(child_->socket());
  Message kind{};
  if (!receiver.receive_kind(kind)) fail_for_child();
  if (kind == Message::error) {
    std::string what;
    if (!receiver.receive_text(what)) fail_for_child();
    throw FileError(what);
  }
  if (!receiver.receive_hello(format_, length_unit_)) fail_for_child();
}

void ForkedReader::start(ReaderFactory make_reader, ChildBounds bounds) try {
  child_ = std::make_unique<ChildProcess>([this, &make_reader, &bounds](int socket) {
    if (bounds.rights) {
      bounds.rights->descriptors.push_back(socket);
      give_up_rights(*bounds.rights);
    }
    FrameSender sender(socket);
    send_all_frames(path_, make_reader, bounds.seconds_per_frame, sender);
  });
  constexpr int kClock = 5;
  child_->set_patience(kClock * bounds.seconds_per_frame);
} catch (const std::system_error& error) {
  fail(path_, std::string("no process to read it in: ") + error.what());
}

bool ForkedReader::read(Frame& frame) {
  if (at_end_) return false;
  FrameReceiver receiver(child_->socket());
  Message kind{};
  if (!receiver.receive_kind(kind)) fail_for_child();
  if (kind == Message::end) {
    at_end_ = true;
    return false;
  }
  if (kind == Message::error) {
    std::string what;
    if (!receiver.receive_text(what)) fail_for_child();
    throw FileError(what);
  }
  if (!receiver.receive_frame(frame) || !is_sound(frame)) fail_for_child();
  ++frames_;
  return true;
}

void ForkedReader::fail_for_child() {
  fail(path_, fmt::format("frame {}: the library that reads this format failed: {}", frames_,
                          child_->wait_and_describe()));
}

}  // namespace dch::trajectory

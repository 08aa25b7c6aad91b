// SPDX-License-Identifier: MIT
#include "forked_reader.hpp"

#include <exception>
#include <fmt/format.h>
#include <new>
#include <system_error>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "frame_channel.hpp"
#include "place.hpp"

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

}  // namespace

ForkedReader::ForkedReader(std::string path, ReaderFactory make_reader, int seconds_per_frame)
    : path_(std::move(path)) {
  start(std::move(make_reader), seconds_per_frame);
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

void ForkedReader::start(ReaderFactory make_reader, int seconds_per_frame) try {
  child_ = std::make_unique<ChildProcess>([this, &make_reader, seconds_per_frame](int socket) {
    FrameSender sender(socket);
    send_all_frames(path_, make_reader, seconds_per_frame, sender);
  });
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
  if (!receiver.receive_frame(frame)) fail_for_child();
  ++frames_;
  return true;
}

void ForkedReader::fail_for_child() {
  fail(path_, fmt::format("frame {}: the library that reads this format failed: {}", frames_,
                          child_->wait_and_describe()));
}

}  // namespace dch::trajectory

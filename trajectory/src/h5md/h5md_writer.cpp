// SPDX-License-Identifier: MIT
#include "h5md/h5md_writer.hpp"

#include <exception>
#include <fmt/format.h>
#include <sys/socket.h>
#include <system_error>

#include <dch/trajectory/file_error.hpp>

#include "base/place.hpp"
#include "frames/frame_check.hpp"
#include "h5md/h5md_file.hpp"
#include "process/frame_channel.hpp"

namespace dch::trajectory {
namespace {

void write_all_frames(const std::string& path, const std::string& name, const std::string& length_unit,
                      FrameReceiver& receiver, FrameSender& sender) try {
  H5mdFile file(path, name, length_unit);
  if (!sender.send_done()) return;
  Frame frame;
  for (Message kind{}; receiver.receive_kind(kind);) {
    if (kind == Message::end) {
      file.close();
      sender.send_done();
      return;
    }
    if (!receiver.receive_frame(frame)) return;
    file.write(frame);
    if (!sender.send_done()) return;
  }
} catch (const FileError& error) {
  sender.send_error(error.what());
} catch (const std::exception& error) {
  sender.send_error(name + ": cannot be written: " + error.what());
}

}  // namespace

H5mdWriter::H5mdWriter(const std::string& path, const std::string& length_unit) : target_(path) {
  start(length_unit);
  await_answer(true);
}

void H5mdWriter::start(const std::string& length_unit) try {
  child_ = std::make_unique<ChildProcess>([&](int socket) {
    FrameReceiver receiver(socket);
    FrameSender sender(socket);
    write_all_frames(target_.descriptor_path(), target_.path(), length_unit, receiver, sender);
  });
} catch (const std::system_error& error) {
  fail(target_.path(), std::string("no process to write it in: ") + error.what());
}

void H5mdWriter::write(const Frame& frame) {
  check_frame(frame, target_.path(), frames_);
  await_answer(FrameSender(child_->socket()).send_frame(frame));
  ++frames_;
}

void H5mdWriter::close() {
  if (!child_) return;
  await_answer(FrameSender(child_->socket()).send_end());
  child_.reset();
  target_.commit();
}

/// A child that was sent no whole message would wait for the rest, as this process for its answer: without a
/// connection it ends.
void H5mdWriter::await_answer(bool was_sent) {
  if (!was_sent) ::shutdown(child_->socket(), SHUT_WR);
  FrameReceiver receiver(child_->socket());
  Message kind{};
  std::string what;
  if (!receiver.receive_kind(kind) || (kind == Message::error && !receiver.receive_text(what))) {
    fail(target_.path(),
         fmt::format("frame {} cannot be written: HDF5 failed: {}", frames_, child_->wait_and_describe()));
  }
  if (kind == Message::error) throw FileError(what);
}

}  // namespace dch::trajectory

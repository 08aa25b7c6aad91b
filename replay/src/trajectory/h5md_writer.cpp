// SPDX-License-Identifier: MIT
#include "h5md_writer.hpp"

#include <exception>
#include <fmt/format.h>
#include <system_error>

#include <dch/trajectory/file_error.hpp>

#include "frame_channel.hpp"
#include "frame_check.hpp"
#include "h5md_file.hpp"
#include "place.hpp"

namespace dch::trajectory {
namespace {

void write_all_frames(const std::string& path, const std::string& name, const std::string& length_unit,
                      FrameReceiver& receiver, FrameSender& sender) try {
  H5mdFile file(path, name, length_unit);
  sender.send_done();
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
  await_answer();
}

void H5mdWriter::start(const std::string& length_unit) try {
  child_ = std::make_unique<ChildProcess>([&](int socket) {
    FrameReceiver receiver(socket);
    FrameSender sender(socket);
    write_all_frames(target_.path(), target_.final_path(), length_unit, receiver, sender);
  });
} catch (const std::system_error& error) {
  fail(target_.final_path(), std::string("no process to write it in: ") + error.what());
}

void H5mdWriter::write(const Frame& frame) {
  check_frame(frame, target_.final_path(), frames_);
  FrameSender(child_->socket()).send_frame(frame);  // if the child has gone, there is no answer either
  await_answer();
  ++frames_;
}

void H5mdWriter::close() {
  if (!child_) return;
  FrameSender(child_->socket()).send_end();
  await_answer();
  child_.reset();
  target_.commit();
}

void H5mdWriter::await_answer() {
  FrameReceiver receiver(child_->socket());
  Message kind{};
  std::string what;
  if (!receiver.receive_kind(kind) || (kind == Message::error && !receiver.receive_text(what))) {
    fail(target_.final_path(),
         fmt::format("frame {} cannot be written: HDF5 failed: {}", frames_, child_->wait_and_describe()));
  }
  if (kind == Message::error) throw FileError(what);
}

}  // namespace dch::trajectory

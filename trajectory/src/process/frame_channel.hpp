// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

/// What one process tells another about a trajectory, over a socket. Both are the same program, so the bytes
/// are those of memory.
enum class Message : int {
  hello,  ///< what kind of file it is
  frame,
  end,   ///< no more frames
  done,  ///< a frame has been written, or the file completed
  error  ///< no more messages
};

/// Sends. Functions return false if the other end has been closed.
class FrameSender {
 public:
  explicit FrameSender(int descriptor) : descriptor_(descriptor) {}
  bool send_hello(const std::string& format, const std::string& length_unit);
  bool send_frame(const Frame& frame);
  bool send_end();
  bool send_done();
  bool send_error(const std::string& what);

 private:
  bool send_kind(Message kind);
  bool send(const void* data, std::size_t size) const;
  bool send_text(const std::string& text);
  template <class T>
  bool send_array(const std::vector<T>& values);

  int descriptor_;
};

/// Receives. Functions return false if the connection ends too early.
class FrameReceiver {
 public:
  explicit FrameReceiver(int descriptor) : descriptor_(descriptor) {}
  bool receive_kind(Message& kind);
  bool receive_hello(std::string& format, std::string& length_unit);
  bool receive_frame(Frame& frame);
  bool receive_text(std::string& text);

 private:
  bool receive(void* data, std::size_t size) const;
  template <class T>
  bool receive_array(std::vector<T>& values);

  int descriptor_;
};

}  // namespace dch::trajectory

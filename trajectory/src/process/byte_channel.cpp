// SPDX-License-Identifier: MIT
#include "process/byte_channel.hpp"

#include <cerrno>
#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

namespace dch::trajectory {

bool send_bytes(int socket, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t done = ::send(socket, bytes, size, MSG_NOSIGNAL);
    if (done < 0 && errno != EINTR) return false;
    if (done > 0) {
      bytes += done;
      size -= static_cast<std::size_t>(done);
    }
  }
  return true;
}

bool receive_bytes(int socket, void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t done = ::read(socket, bytes, size);
    if (done == 0 || (done < 0 && errno != EINTR)) return false;
    if (done > 0) {
      bytes += done;
      size -= static_cast<std::size_t>(done);
    }
  }
  return true;
}

}  // namespace dch::trajectory

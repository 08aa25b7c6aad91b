// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace dch::trajectory {

/// Sends all the bytes over a socket; false if the other end has been closed.
bool send_bytes(int socket, const void* data, std::size_t size);

/// Receives so many bytes; false if the connection ends before.
bool receive_bytes(int socket, void* data, std::size_t size);

}  // namespace dch::trajectory

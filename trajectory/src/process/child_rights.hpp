// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace dch::trajectory {

/// What a child process keeps when it gives up its rights.
struct ChildRights {
  std::vector<int> descriptors;  ///< stay open, besides the standard streams
  std::int64_t memory = 0;       ///< address space beyond what the process has now [bytes]
};

/// Gives up the rights of this process for good. Afterwards it can use the memory it is left, read what it
/// has open, send and write there, look at the clock and end; to open a file, make a socket, start a process
/// or a program, map code, or signal others fails with EPERM. It has no descriptors but those named, can get
/// no others, and can make no file longer than 64 KiB.
///
/// Returns false if the kernel or the processor does not know the filter of system calls (seccomp): then only
/// the limits of memory, descriptors and file sizes hold. Call it in a child with one thread.
bool give_up_rights(const ChildRights& rights);

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dch::trajectory {

/// Notes a temporary file for remove_unfinished_files(). Returns its place for forget_unfinished_file(), -1
/// if all places are taken: then a signal that ends the process at once leaves the file behind.
int note_unfinished_file(const std::string& path) noexcept;

/// The file at that place has been removed or has got its name. Nothing for a place of -1.
void forget_unfinished_file(int place) noexcept;

}  // namespace dch::trajectory

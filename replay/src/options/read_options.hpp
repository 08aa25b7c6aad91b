// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <dch/trajectory/reader.hpp>

namespace dch::cli {

class Command;

/// Adds --max-expanded, for every command that reads files; its word is left in `word`, empty if not given.
void add_max_expanded(Command& command, std::string& word);

/// What the word says: bytes, or a number of K, M, G or T (powers of 1024).
/// @throws UsageError for anything else, and outside of 1M to 1,024T.
trajectory::ReadLimits parse_max_expanded(const std::string& word);

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dch::cli {

/// A command line that could not be parsed.
struct Misuse {
  std::string command;                   ///< the last one that the words name, with those above it
  std::vector<std::string> subcommands;  ///< its subcommands
  std::vector<std::string> options;      ///< its options, with their dashes
  std::vector<std::string> unknown;      ///< words that nothing takes
  std::string kind, text;                ///< CLI11's name of the error, and its message
};

/// What is wrong with a command line: names the unknown word, what is known and what may have been meant, and
/// where the help is.
std::string usage_message(const Misuse& misuse);

/// "unknown subcommand 'infos' ..." for a word that is none of those of the command.
std::string unknown_subcommand(const std::string& command, const std::vector<std::string>& known,
                               const std::string& word);

/// The candidate that `word` is a slip of the finger for: one that begins with it, or else the one with the
/// fewest letters changed, added, left out or swapped, a third of the word at most; empty if there is none.
std::string closest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dch::cli

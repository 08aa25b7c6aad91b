// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace dch::cli {

/// What is wrong with a command line that could not be parsed: names the unknown word, what is known and what
/// may have been meant, and where the help is.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

/// "unknown subcommand 'infos' ..." for a word that is none.
std::string unknown_subcommand(const CLI::App& command, const std::string& word);

/// The candidate that `word` is a slip of the finger for: one that begins with it, or else the one with the
/// fewest letters changed, added, left out or swapped, a third of the word at most; empty if there is none.
std::string closest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace dch::cli

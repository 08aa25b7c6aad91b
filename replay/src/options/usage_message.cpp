// SPDX-License-Identifier: MIT
#include "options/usage_message.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dch::cli {
namespace {

/// Letters to change, add, leave out or swap with their neighbor to make one word of the other.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        edits[i][j] = i + j;
        continue;
      }
      const bool differs = a[i - 1] != b[j - 1];
      edits[i][j] =
          std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (differs ? 1 : 0)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string closest = closest_word(word, candidates);
  return closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest);
}

/// CLI11's own message, or a plainer one.
std::string plain_words(const Misuse& misuse) {
  if (misuse.kind != "ArgumentMismatch") return misuse.text;
  const std::string option = misuse.text.substr(0, misuse.text.find(':'));
  const bool twice = misuse.text.find("At Most") != std::string::npos;
  return option + (twice ? " is given more than once; give it once" : " needs a value");
}

}  // namespace

std::string closest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string closest;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const bool begun = word.size() > 2 && candidate.compare(0, word.size(), word) == 0;
    const std::size_t edits = begun ? 0 : edits_between(word, candidate);
    if (edits >= fewest) continue;
    fewest = edits;
    closest = candidate;
  }
  return closest;
}

std::string unknown_subcommand(const std::string& command, const std::vector<std::string>& known,
                               const std::string& word) {
  if (known.empty())
    return fmt::format("unknown subcommand '{}': {} has none; see {} --help", word, command, command);
  return fmt::format("unknown subcommand '{}'{}; {} has {}; see {} --help", word, suggestion(word, known),
                     command, fmt::join(known, ", "), command);
}

std::string usage_message(const Misuse& misuse) {
  const std::string& name = misuse.command;
  const std::vector<std::string>& unknown = misuse.unknown;
  const auto option = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-' && word != "--";
  });
  const std::vector<std::string>& known = misuse.subcommands;
  if (!known.empty() && !unknown.empty() && option != unknown.begin()) {
    return unknown_subcommand(name, known, unknown.front());
  }
  if (option != unknown.end()) {
    const std::string word = option->substr(0, option->find('='));
    return fmt::format("unknown option '{}'{}; see {} --help", word, suggestion(word, misuse.options), name);
  }
  if (!known.empty()) {
    return fmt::format("{} needs a subcommand: {}; see {} --help", name, fmt::join(known, ", "), name);
  }
  if (!unknown.empty()) {
    return fmt::format("'{}' is one argument too many; see {} --help", unknown.front(), name);
  }
  return fmt::format("{}; see {} --help", plain_words(misuse), name);
}

}  // namespace dch::cli

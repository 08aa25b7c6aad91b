// SPDX-License-Identifier: GPL-2.0-or-later
#include "table_file.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace dch::lammps {
namespace {

/// Words of the next line that has some, without its comment; none at the end of the file.
std::vector<std::string> next_words(std::istream& file) {
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream text(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (!words.empty()) return words;
  }
  return {};
}

double distance(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end == word.c_str() + word.size() && std::isfinite(value) && value > 0 ? value : 0;
}

}  // namespace

double first_distance(std::istream& file, const std::string& keyword) {
  std::vector<std::string> words = next_words(file);
  while (!words.empty() && words[0] != keyword) words = next_words(file);
  if (words.empty()) return 0;
  words = next_words(file);  // N, and how distances are given
  for (std::size_t k = 0; k + 1 < words.size(); ++k)
    if (words[k] == "R" || words[k] == "RSQ") return distance(words[k + 1]);
  std::string blank;
  std::getline(file, blank);
  words = next_words(file);
  return words.size() < 2 ? 0 : distance(words[1]);
}

}  // namespace dch::lammps

// SPDX-License-Identifier: MIT
#include <cstdint>
#include <fmt/format.h>

#include "base/text.hpp"
#include "topology/topology_files.hpp"

namespace dch::trajectory {
namespace {

/// The lines of a LAMMPS data file that hold something: comments and blank lines are passed over.
class DataLines {
 public:
  DataLines(const std::string& path, const ReadLimits& limits)
      : lines_(path, FinalNewline::required, limits) {
    std::string_view title;
    lines_.next(title);  // LAMMPS never looks at the first line
  }

  /// The next line, split into words; false at the end of the file. Words are valid until the next call.
  bool next(std::vector<std::string_view>& words) {
    std::string_view line;
    while (lines_.next(line)) {
      line = line.substr(0, line.find('#'));
      words.clear();
      for (std::string_view word; next_word(line, word);) words.push_back(word);
      if (!words.empty()) return true;
    }
    return false;
  }

  const LineReader& reader() const { return lines_; }

 private:
  LineReader lines_;
};

/// "120 bonds" in the header.
bool is_bond_count(const std::vector<std::string_view>& words, std::int64_t& count) {
  return words.size() == 2 && words[1] == "bonds" && parse_number(words[0], count);
}

}  // namespace

std::vector<IndexPair> read_lammps_data_bonds(const std::string& path, const AtomIndex& atoms,
                                              const ReadLimits& limits) {
  DataLines lines(path, limits);
  std::vector<std::string_view> words;
  std::int64_t count = -1;
  while (true) {
    if (!lines.next(words)) {
      if (count <= 0) return {};
      lines.reader().fail_here(
          fmt::format("the file ends without the section 'Bonds' of its {} bonds", count));
    }
    if (count < 0 && is_bond_count(words, count) && count < 0) {
      lines.reader().fail_here("expected a number of bonds, found " + in_quotes(words[0]));
    }
    if (words.size() == 1 && words[0] == "Bonds") break;
  }
  if (count < 0)
    lines.reader().fail_here("a section 'Bonds', but the header does not say how many bonds there are");

  std::vector<IndexPair> bonds;
  while (static_cast<std::int64_t>(bonds.size()) < count) {
    if (!lines.next(words)) {
      lines.reader().fail_here(
          fmt::format("the file ends after {} of {} bonds: it is truncated", bonds.size(), count));
    }
    if (words.size() != 4) {
      lines.reader().fail_here(
          fmt::format("expected a bond (number, type, two atom ids; {} of {}), found {} words",
                      bonds.size() + 1, count, words.size()));
    }
    const std::int32_t a = atoms.parse(lines.reader(), words[2]);
    bonds.push_back(make_bond(lines.reader(), a, atoms.parse(lines.reader(), words[3])));
  }
  const bool starts_with_digit = lines.next(words) && words[0][0] >= '0' && words[0][0] <= '9';
  if (starts_with_digit)
    lines.reader().fail_here(fmt::format("the header says {} bonds, but there are more", count));
  return bonds;
}

}  // namespace dch::trajectory

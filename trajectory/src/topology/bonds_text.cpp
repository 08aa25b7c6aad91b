// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/text.hpp"
#include "topology/topology_files.hpp"

namespace dch::trajectory {

IndexPair make_bond(const LineReader& lines, std::int32_t a, std::int32_t b) {
  if (a == b) lines.fail_here("a bond of an atom with itself");
  return {a, b};
}

std::vector<IndexPair> read_bonds_text(const std::string& path, const AtomIndex& atoms,
                                       const ReadLimits& limits) {
  LineReader lines(path, FinalNewline::optional, limits);
  std::vector<IndexPair> bonds;
  for (std::string_view line; lines.next(line);) {
    std::string_view rest = line.substr(0, line.find('#')), first, second;
    if (is_blank(rest)) continue;
    if (!next_word(rest, first) || !next_word(rest, second) || !is_blank(rest)) {
      lines.fail_here("expected the ids of two atoms, found " + in_quotes(line));
    }
    const std::int32_t a = atoms.parse(lines, first);
    bonds.push_back(make_bond(lines, a, atoms.parse(lines, second)));
  }
  return bonds;
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include <cstdint>
#include <fmt/format.h>

#include "text.hpp"
#include "topology_files.hpp"

namespace dch::trajectory {
namespace {

/// Adds the atoms that a word names: "7", or a range "7-12", which may also run downwards.
void add_atoms(const LineReader& lines, const AtomIndex& atoms, std::string_view word,
               std::vector<std::int32_t>& chain) {
  const std::size_t dash = word.find('-', 1);
  if (dash == std::string_view::npos) {
    chain.push_back(atoms.parse(lines, word));
    return;
  }
  std::int64_t first = 0, last = 0;
  if (!parse_number(word.substr(0, dash), first) || !parse_number(word.substr(dash + 1), last)) {
    lines.fail_here("expected an id or a range of ids such as 7-12, found " + in_quotes(word));
  }
  const std::int64_t step = first <= last ? 1 : -1;
  for (std::int64_t id = first; id != last; id += step) chain.push_back(atoms.find(lines, id));
  chain.push_back(atoms.find(lines, last));
}

}  // namespace

std::vector<IndexPair> read_chains_text(const std::string& path, const AtomIndex& atoms) {
  LineReader lines(path, FinalNewline::optional);
  std::vector<IndexPair> bonds;
  std::vector<std::int32_t> chain;
  for (std::string_view line; lines.next(line);) {
    chain.clear();
    bool is_ring = false;
    std::string_view rest = line.substr(0, line.find('#'));
    for (std::string_view word; next_word(rest, word);) {
      if (chain.empty() && !is_ring && word == "ring") {
        is_ring = true;
      } else {
        add_atoms(lines, atoms, word, chain);
      }
    }
    if (is_ring && chain.size() < 3) {
      lines.fail_here(fmt::format("a ring needs three atoms at least, found {}", chain.size()));
    }
    for (std::size_t k = 1; k < chain.size(); ++k) bonds.push_back(make_bond(lines, chain[k - 1], chain[k]));
    if (is_ring) bonds.push_back(make_bond(lines, chain.back(), chain.front()));
  }
  return bonds;
}

}  // namespace dch::trajectory

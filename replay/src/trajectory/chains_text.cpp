// SPDX-License-Identifier: MIT
#include <cstdint>
#include <fmt/format.h>
#include <utility>

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

Topology read_chains_text(const std::string& path, const AtomIndex& atoms) {
  LineReader lines(path, FinalNewline::optional);
  Topology topology;
  topology.source = path;
  for (std::string_view line; lines.next(line);) {
    AtomChain chain;
    chain.line = lines.number();
    std::string_view rest = line.substr(0, line.find('#'));
    for (std::string_view word; next_word(rest, word);) {
      if (chain.atoms.empty() && !chain.closed && word == "ring") {
        chain.closed = true;
      } else {
        add_atoms(lines, atoms, word, chain.atoms);
      }
    }
    const std::size_t size = chain.atoms.size();
    if (chain.closed && size < 3) {
      lines.fail_here(fmt::format("a ring needs three atoms at least, found {}", size));
    }
    for (std::size_t k = 1; k < size; ++k) {
      topology.bonds.push_back(make_bond(lines, chain.atoms[k - 1], chain.atoms[k]));
    }
    if (chain.closed) topology.bonds.push_back(make_bond(lines, chain.atoms.back(), chain.atoms.front()));
    if (size > 0) topology.chains.push_back(std::move(chain));
  }
  return topology;
}

}  // namespace dch::trajectory

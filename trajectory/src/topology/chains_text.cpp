// SPDX-License-Identifier: MIT
#include <cstdint>
#include <fmt/format.h>
#include <utility>

#include "base/text.hpp"
#include "topology/topology_files.hpp"

namespace dch::trajectory {
namespace {

/// Reads the words of chains. Ranges are a few bytes for any number of atoms, so there is a bound on what
/// they may name in all.
class ChainWords {
 public:
  ChainWords(const LineReader& lines, const AtomIndex& atoms) : lines_(lines), atoms_(atoms) {}

  /// Adds the atoms that a word names: "7", or a range "7-12", which may also run downwards.
  void add(std::string_view word, std::vector<std::int32_t>& chain) {
    const std::size_t dash = word.find('-', 1);
    if (dash == std::string_view::npos) {
      chain.push_back(atoms_.parse(lines_, word));
      return;
    }
    std::int64_t first = 0, last = 0;
    if (!parse_number(word.substr(0, dash), first) || !parse_number(word.substr(dash + 1), last)) {
      lines_.fail_here("expected an id or a range of ids such as 7-12, found " + in_quotes(word));
    }
    const std::int64_t step = first <= last ? 1 : -1;
    for (std::int64_t id = first; id != last; id += step) add_of_range(id, chain);
    add_of_range(last, chain);
  }

 private:
  void add_of_range(std::int64_t id, std::vector<std::int32_t>& chain) {
    constexpr std::size_t kMaxTimes = 16;
    chain.push_back(atoms_.find(lines_, id));
    if (++in_ranges_ <= kMaxTimes * atoms_.size()) return;
    lines_.fail_here(
        fmt::format("the ranges up to here name {} atoms, more than {} times the trajectory's {}: name each "
                    "atom once, or a few times where chains branch",
                    in_ranges_, kMaxTimes, atoms_.size()));
  }

  const LineReader& lines_;
  const AtomIndex& atoms_;
  std::size_t in_ranges_ = 0;  ///< atoms named so far
};

}  // namespace

Topology read_chains_text(const std::string& path, const AtomIndex& atoms, const ReadLimits& limits) {
  LineReader lines(path, FinalNewline::optional, limits);
  ChainWords words(lines, atoms);
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
        words.add(word, chain.atoms);
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

// SPDX-License-Identifier: MIT
#include "input/chain_topology.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <sstream>
#include <utility>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/topology.hpp>

#include "base/exit_code.hpp"
#include "base/number_text.hpp"
#include "options/option_values.hpp"

namespace dch::cli {
namespace {

using trajectory::FileError;
using trajectory::Topology;

/// Which atoms of a frame are beads.
class BeadNumbers {
 public:
  explicit BeadNumbers(const trajectory::Frame& frame) : frame_(frame), number_(frame.ids.size(), kNone) {}

  void take(std::int32_t atom) { number_[static_cast<std::size_t>(atom)] = 0; }

  /// Numbers the beads in order of id; no chains yet.
  BeadChains gather(std::string source) {
    BeadChains beads;
    beads.source = std::move(source);
    for (std::size_t atom = 0; atom < number_.size(); ++atom) {
      if (number_[atom] == kNone) continue;
      number_[atom] = static_cast<std::int32_t>(beads.ids.size());
      beads.ids.push_back(frame_.ids[atom]);
      if (!frame_.types.empty()) beads.types.push_back(frame_.types[atom]);
    }
    beads.chains = necklace::Chains(beads.ids.size());
    return beads;
  }

  std::int32_t operator()(std::int32_t atom) const { return number_[static_cast<std::size_t>(atom)]; }

 private:
  static constexpr std::int32_t kNone = -1;
  const trajectory::Frame& frame_;
  std::vector<std::int32_t> number_;
};

/// No atom stands in two chains of the file, or in one twice.
void check_chains(const Topology& topology, const trajectory::Frame& frame) {
  std::vector<std::int64_t> line(frame.ids.size(), 0);
  for (const trajectory::AtomChain& chain : topology.chains) {
    for (const std::int32_t atom : chain.atoms) {
      std::int64_t& before = line[static_cast<std::size_t>(atom)];
      const std::int64_t id = frame.ids[static_cast<std::size_t>(atom)];
      if (before == chain.line) {
        throw FileError(
            fmt::format("{}: line {}: the atom with the id {} stands in this chain twice; name it once, and "
                        "close a ring with the word ring in front",
                        topology.source, chain.line, id));
      }
      if (before != 0) {
        throw FileError(
            fmt::format("{}: line {}: the atom with the id {} stands in the chain of line {} already; an "
                        "atom belongs to one chain at most",
                        topology.source, chain.line, id, before));
      }
      before = chain.line;
    }
  }
}

/// No bond is given twice, and no atom has three.
void check_bonds(const Topology& topology, const trajectory::Frame& frame) {
  const auto id = [&](std::int32_t atom) { return frame.ids[static_cast<std::size_t>(atom)]; };
  std::vector<IndexPair> bonds;
  for (const auto& [a, b] : topology.bonds) bonds.push_back({std::min(a, b), std::max(a, b)});
  std::sort(bonds.begin(), bonds.end());
  const auto twice = std::adjacent_find(bonds.begin(), bonds.end());
  if (twice != bonds.end()) {
    throw FileError(
        fmt::format("{}: the bond of the atoms with the ids {} and {} is given twice; give it once",
                    topology.source, id((*twice)[0]), id((*twice)[1])));
  }
  std::vector<int> count(frame.ids.size(), 0);
  for (const IndexPair& bond : bonds) {
    for (const std::int32_t atom : bond) {
      if (++count[static_cast<std::size_t>(atom)] < 3) continue;
      throw FileError(fmt::format(
          "{}: the atom with the id {} has three bonds or more, but an atom of a chain has two at "
          "most; give chains without side groups and cross-links in a .chains file",
          topology.source, id(atom)));
    }
  }
}

BeadChains from_chains(const Topology& topology, const trajectory::Frame& frame) {
  check_chains(topology, frame);
  BeadNumbers numbers(frame);
  for (const auto& chain : topology.chains) {
    for (const std::int32_t atom : chain.atoms) numbers.take(atom);
  }
  BeadChains beads = numbers.gather(topology.source);
  for (const auto& chain : topology.chains) {
    std::vector<std::int32_t> row;
    for (const std::int32_t atom : chain.atoms) row.push_back(numbers(atom));
    beads.chains.add(row, chain.closed);
  }
  return beads;
}

BeadChains from_bonds(const Topology& topology, const trajectory::Frame& frame) {
  check_bonds(topology, frame);
  BeadNumbers numbers(frame);
  for (const auto& [a, b] : topology.bonds) numbers.take(a), numbers.take(b);
  BeadChains beads = numbers.gather(topology.source);
  std::vector<IndexPair> bonds;
  for (const auto& [a, b] : topology.bonds) bonds.push_back({numbers(a), numbers(b)});
  beads.chains = necklace::Chains::from_bonds(beads.ids.size(), bonds);
  return beads;
}

/// The molecule column with 0, which is none, for those that were not asked for.
std::vector<std::int32_t> chosen_molecules(const std::string& file, const ChainSource& source,
                                           std::vector<std::int32_t> molecules) {
  if (source.molecules.empty()) return molecules;
  std::vector<bool> found(source.molecules.size(), false);
  for (std::int32_t& molecule : molecules) {
    bool chosen = false;
    for (std::size_t k = 0; k < source.molecules.size(); ++k) {
      const auto& [first, last] = source.molecules[k];
      if (molecule < first || molecule > last) continue;
      chosen = found[k] = true;
    }
    if (!chosen) molecule = 0;
  }
  const auto missing = std::find(found.begin(), found.end(), false);
  if (missing != found.end()) {
    const auto& [first, last] = source.molecules[static_cast<std::size_t>(missing - found.begin())];
    throw UsageError(
        fmt::format("--molecules: the first frame of {} has no molecule {}; name those it has", file,
                    first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last)));
  }
  return molecules;
}

Topology chains_of_length(const std::string& file, std::int64_t length, const trajectory::Frame& frame) {
  const auto atoms = static_cast<std::int64_t>(frame.ids.size());
  if (atoms % length != 0) {
    throw UsageError(fmt::format(
        "--chain-length {}: {} has {}, which do not make whole chains of that length; give the chains with "
        "--topology",
        length, file, counted(atoms, "atom")));
  }
  Topology topology;
  topology.source = fmt::format("chains of {} atoms in order of id of {}", length, file);
  for (std::int64_t first = 0; first < atoms; first += length) {
    trajectory::AtomChain chain;
    chain.line = 1 + first / length;
    for (std::int64_t k = 0; k < length; ++k) chain.atoms.push_back(static_cast<std::int32_t>(first + k));
    topology.chains.push_back(std::move(chain));
  }
  return topology;
}

Topology read(const std::string& file, const ChainSource& source, const trajectory::Frame& frame,
              const trajectory::ReadLimits& limits) {
  if (!source.topology.empty()) return trajectory::read_topology(source.topology, frame.ids, limits);
  if (source.length > 0) return chains_of_length(file, source.length, frame);
  if (frame.molecules.empty()) {
    throw UsageError(
        fmt::format("contacts need chains, but {} has no molecule column; give them with --topology, or with "
                    "--chain-length if all chains have one length and their atoms follow each other",
                    file));
  }
  trajectory::Frame chosen;
  chosen.molecules = chosen_molecules(file, source, frame.molecules);
  return trajectory::topology_from_molecules(chosen, file);
}

std::pair<std::int32_t, std::int32_t> parse_molecules(const std::string& part) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
  const char* const meaning = "numbers of molecules, for example 1,4-7";
  const std::size_t dash = part.find('-', 1);
  const auto number = [&](const std::string& text) {
    return static_cast<std::int32_t>(parse_whole_number("--molecules", text, 1, kMax, meaning));
  };
  const std::int32_t first = number(part.substr(0, dash));
  const std::int32_t last = dash == std::string::npos ? first : number(part.substr(dash + 1));
  if (first > last)
    throw UsageError(fmt::format("--molecules {}: {} is above {}; give {}", part, first, last, meaning));
  return {first, last};
}

}  // namespace

ChainSource::ChainSource(const std::string& file, const std::string& molecules_text,
                         const std::string& length_text)
    : topology(file) {
  const int given = !file.empty() + !molecules_text.empty() + !length_text.empty();
  if (given > 1) {
    throw UsageError(
        "--topology, --molecules and --chain-length each say where the chains are; give one of them");
  }
  std::istringstream parts(molecules_text);
  for (std::string part; std::getline(parts, part, ',');) molecules.push_back(parse_molecules(part));
  if (length_text.empty()) return;
  length = parse_whole_number("--chain-length", length_text, 2, std::numeric_limits<std::int32_t>::max(),
                              "the number of beads of each chain");
}

BeadChains read_bead_chains(const std::string& file, const ChainSource& source,
                            const trajectory::Frame& frame, const trajectory::ReadLimits& limits) {
  const Topology found = read(file, source, frame, limits);
  if (found.chains.empty() && found.bonds.empty()) {
    throw FileError(
        fmt::format("{}: no bonds and no chains, so there is nothing to find contacts of; give a "
                    "file that has them with --topology",
                    found.source));
  }
  return found.chains.empty() ? from_bonds(found, frame) : from_chains(found, frame);
}

BeadFinder::BeadFinder(std::string file, const BeadChains& beads)
    : file_(std::move(file)), source_(beads.source), ids_(beads.ids), positions_(beads.ids.size()) {}

const std::vector<Vec3>& BeadFinder::positions(const trajectory::Frame& frame, std::int64_t index) {
  if (frame.ids != atom_ids_) find(frame, index);
  for (std::size_t bead = 0; bead < atoms_.size(); ++bead) positions_[bead] = frame.positions[atoms_[bead]];
  return positions_;
}

void BeadFinder::find(const trajectory::Frame& frame, std::int64_t index) {
  atoms_.clear();
  auto next = frame.ids.begin();
  for (const std::int64_t id : ids_) {
    next = std::lower_bound(next, frame.ids.end(), id);
    if (next == frame.ids.end() || *next != id) {
      throw FileError(fmt::format(
          "{}: frame {}: has {} and none with the id {}, which stands in a chain of {}; leave the "
          "frame out with --frames or the atom out of the chains",
          file_, index, counted(static_cast<std::int64_t>(frame.ids.size()), "atom"), id, source_));
    }
    atoms_.push_back(static_cast<std::size_t>(next - frame.ids.begin()));
  }
  atom_ids_ = frame.ids;
}

}  // namespace dch::cli

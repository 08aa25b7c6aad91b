// SPDX-License-Identifier: MIT
#include "chain_topology.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/topology.hpp>

#include "exit_code.hpp"
#include "number_text.hpp"

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

Topology read(const std::string& file, const std::string& topology, const trajectory::Frame& frame,
              const trajectory::ReadLimits& limits) {
  if (!topology.empty()) return trajectory::read_topology(topology, frame.ids, limits);
  if (frame.molecules.empty()) {
    throw UsageError(
        fmt::format("contacts need chains, but {} has no molecule column; give them with --topology", file));
  }
  return trajectory::topology_from_molecules(frame, file);
}

}  // namespace

BeadChains read_bead_chains(const std::string& file, const std::string& topology,
                            const trajectory::Frame& frame, const trajectory::ReadLimits& limits) {
  const Topology found = read(file, topology, frame, limits);
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

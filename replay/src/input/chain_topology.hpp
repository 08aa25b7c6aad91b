// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <dch/necklace/chains.hpp>
#include <dch/trajectory/frame.hpp>
#include <dch/trajectory/reader.hpp>

namespace dch::cli {

/// The chains of a trajectory. Their particles are the beads alone, in ascending order of id.
struct BeadChains {
  necklace::Chains chains;
  std::vector<std::int64_t> ids;    ///< by particle, ascending
  std::vector<std::int32_t> types;  ///< by particle; empty if the frame has none
  std::string source;               ///< of the chains, for messages
};

/// Where the chains of a trajectory are.
struct ChainSource {
  ChainSource() = default;
  ChainSource(std::string file) : topology(std::move(file)) {}

  std::string topology;  ///< a file; empty: the molecule column, unless a length is given
  std::vector<std::pair<std::int32_t, std::int32_t>>
      molecules;  ///< first and last of those that are chains; empty: all
  std::int64_t length =
      0;  ///< above 0: atoms in order of id make chains of that many, and no column is needed

  /// How the command line gave it. @throws UsageError for numbers that are none, and two sources.
  ChainSource(const std::string& file, const std::string& molecules_text, const std::string& length_text);
};

/// Reads chains from a topology file, or from the molecule column of the frame if none is named. Chains of a
/// .chains file keep its order; others are made of bonds (Chains::from_bonds), so atoms without a bond are in
/// none.
/// @param file the trajectory's name, for messages
/// @throws trajectory::FileError for a file that cannot be read or is broken, an id that the frame does not
///   have, an atom in two chains or twice in one, three bonds of an atom, a bond given twice, and no chain at
///   all; UsageError if no file is named and the frame has no molecules or not those asked for, or if its
///   atoms do not make chains of the length.
BeadChains read_bead_chains(const std::string& file, const ChainSource& source,
                            const trajectory::Frame& frame, const trajectory::ReadLimits& limits = {});

/// Finds the beads in frame after frame by their ids. Other atoms may come and go.
class BeadFinder {
 public:
  BeadFinder(std::string file, const BeadChains& beads);

  /// Positions of the beads by particle, valid until the next call.
  /// @param index of the frame, for messages
  /// @throws trajectory::FileError naming the first bead that the frame does not have.
  const std::vector<Vec3>& positions(const trajectory::Frame& frame, std::int64_t index);
  const std::vector<Vec3>& last_positions() const { return positions_; }

 private:
  void find(const trajectory::Frame& frame, std::int64_t index);

  std::string file_, source_;
  std::vector<std::int64_t> ids_;       ///< of the beads
  std::vector<std::int64_t> atom_ids_;  ///< of the frame that atoms_ is for
  std::vector<std::size_t> atoms_;      ///< by bead
  std::vector<Vec3> positions_;
};

}  // namespace dch::cli

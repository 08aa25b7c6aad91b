// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "pair_check.hpp"
#include "scene.hpp"

namespace dch::bench {

/// Lists beside those of the hierarchy, of another library most often, for a scene in a periodic cuboid with
/// a single list radius.
class PeerLists {
 public:
  virtual ~PeerLists() = default;

  virtual std::string name() const = 0;
  /// Copies the scene's positions to where make() reads them, wrapped into the box.
  virtual void take(const Scene& scene) = 0;
  /// Gives up what is kept from one list to the next, if anything is.
  virtual void forget() {}
  /// Makes the list; what is timed.
  virtual void make() = 0;
  /// The pairs of the list that are within the radius.
  virtual PairSum pairs_within(const Scene& scene) const = 0;
  /// Number of pairs that the list holds, with those that are farther apart.
  virtual std::int64_t pairs_held() const = 0;
  /// Whether distances are taken in double: then not even a pair at the very radius may differ.
  virtual bool in_double() const { return false; }
};

using PeerMaker = std::function<std::unique_ptr<PeerLists>(const Scene&)>;

/// The program that compares such lists with those of the hierarchy, and times both in turn. Returns its
/// status: 1 for a wrong list, 2 for wrong options, 3 for what cannot be read.
/// @param make_more another kind of lists to compare with those of the peer too
int run_beside(int argc, char** argv, const PeerMaker& make_peer, const PeerMaker& make_more = {});

}  // namespace dch::bench

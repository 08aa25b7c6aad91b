// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "contender.hpp"
#include "program.hpp"
#include "scene.hpp"

namespace dch::bench {

using Contenders = std::vector<std::unique_ptr<Contender>>;

/// What check_lists() goes through. Lists are compared with each other at every configuration.
struct ListCheck {
  int last = 0;             ///< number of the last configuration
  bool expect_all = false;  ///< compare with expected_pairs() everywhere, not at the first and the last alone
  int structures_checked = 0;  ///< validate() structures at so many configurations; it looks at all pairs
  int superset_every = 1;      ///< make supersets at every Nth configuration
};

/// What it has seen.
struct CheckedLists {
  int configurations = 0;
  int expected = 0;             ///< configurations compared with expected_pairs()
  int structures = 0;           ///< validated
  std::int64_t pairs = 0;       ///< of all configurations, each counted once for each list
  std::int64_t last_pairs = 0;  ///< of the last configuration
  std::uint64_t last_hash = 0;  ///< PairSum's, of all its lists added up
};

/// The lists of all contenders, made anew at the first configuration and kept up to the last, or to the last
/// that there is.
/// @throws WrongAnswer if one has not the pairs of another, or not those expected, or its structure is
/// broken.
CheckedLists check_lists(Scene& scene, Contenders& contenders, const ListCheck& check);

}  // namespace dch::bench

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include <dch/forces/lennard_jones.hpp>

namespace dch::lammps {

/// When atoms are put in memory in the order of the structure. `automatic`: unless they have bonds, where
/// nothing was gained, or a fix is in use that may draw random numbers atom by atom, so that another order
/// would be another trajectory.
enum class OrderAtoms { automatic, always, never };

/// When lists expire. `exact`: when a pair within its cutoff is missing. `half`: when an atom has moved half
/// the skin, LAMMPS's rule. `automatic`: exact, unless a fix is in use that may draw random numbers atom by
/// atom, and builds at other steps would be another trajectory.
enum class ExpiryRule { automatic, exact, half };

/// What one `dch ...` line of an input script asks for.
struct Request {
  enum class Action { on, off, stats, explain, verify, precision, threads, skin, order, expiry, styles };
  Action action = Action::on;
  std::string engine;    ///< `on`: what fills lists, see dch::make_search; empty if none was named
  bool has_c = false;    ///< `on c`, which has no effect any more
  int verify_every = 0;  ///< `verify`: 0 = never, 1 = at every build of the lists, N = at every Nth
  ForcePrecision precision = ForcePrecision::double_precision;  ///< `precision`: of force styles of ours
  bool tunes_skin = false;                                      ///< `skin`: auto, not fixed
  OrderAtoms order_atoms = OrderAtoms::automatic;               ///< `order`
  ExpiryRule expiry = ExpiryRule::automatic;                    ///< `expiry`
  bool takes_styles = true;                                     ///< `styles`: auto, not no
  int threads = 1;                                              ///< `threads`: of each process
};

/// Parses the words after `dch`.
/// @throws dch::InvalidParameter naming the word, what is allowed and an example.
Request parse_request(const std::vector<std::string>& words);

}  // namespace dch::lammps

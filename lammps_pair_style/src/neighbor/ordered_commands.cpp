// SPDX-License-Identifier: GPL-2.0-or-later
#include "ordered_commands.h"

#include <array>
#include <input.h>
#include <lammps_host.h>
#include <string>
#include <utility>

#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// reset_ids has become reset_atom_ids, and that reset_atoms.
constexpr std::array kCommands = {"create_atoms", "delete_atoms", "reset_ids", "reset_atom_ids",
                                  "reset_atoms"};

/// What LAMMPS makes its k-th of the commands with.
template <std::size_t k>
Input::CommandCreator stock_creator = nullptr;

template <std::size_t k>
Command* create_in_order(LAMMPS* lammps) {
  if (auto* ours = dynamic_cast<NeighborDCH*>(lammps->neighbor)) ours->restore_order_between_runs();
  return stock_creator<k>(lammps);
}

template <std::size_t k>
void take_over(Input::CommandCreatorMap& commands) {
  const auto found = commands.find(kCommands[k]);
  if (found == commands.end() || found->second == &create_in_order<k>) return;
  stock_creator<k> = std::exchange(found->second, &create_in_order<k>);
}

template <std::size_t... k>
void take_over_all(Input::CommandCreatorMap& commands, std::index_sequence<k...>) {
  (take_over<k>(commands), ...);
}

}  // namespace

void restore_order_before_commands(LAMMPS& lammps) {
  take_over_all(*lammps.input->command_map, std::make_index_sequence<kCommands.size()>());
}

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <dch/trajectory/topology.hpp>

#include "base/place.hpp"
#include "files/file_name.hpp"
#include "topology/topology_files.hpp"

namespace dch::trajectory {

Topology read_topology(const std::string& path, const std::vector<std::int64_t>& ids,
                       const ReadLimits& limits) {
  const AtomIndex atoms(ids);
  const std::string name = lower_case_name(path);
  if (has_ending(name, ".bonds")) return {read_bonds_text(path, atoms, limits), path, {}};
  if (has_ending(name, ".chains")) return read_chains_text(path, atoms, limits);
  if (has_ending(name, ".data") || has_ending(name, ".lmp") || name.substr(0, 5) == "data.") {
    return {read_lammps_data_bonds(path, atoms, limits), path, {}};
  }
  fail(path,
       "unknown kind of topology; known are LAMMPS data files (.data, .lmp, data.*), .bonds and .chains");
}

Topology topology_from_molecules(const Frame& frame, const std::string& path) {
  if (frame.molecules.empty() && !frame.positions.empty()) {
    fail(path, "the frame has no column of molecule numbers (mol); name a topology file instead");
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> members;  // (molecule, atom); atoms are in order of id
  for (std::size_t k = 0; k < frame.molecules.size(); ++k) {
    if (frame.molecules[k] != 0) members.emplace_back(frame.molecules[k], static_cast<std::int32_t>(k));
  }
  std::sort(members.begin(), members.end());

  Topology topology;
  topology.source = "molecules of " + path;
  for (std::size_t k = 1; k < members.size(); ++k) {
    if (members[k].first == members[k - 1].first)
      topology.bonds.push_back({members[k - 1].second, members[k].second});
  }
  return topology;
}

}  // namespace dch::trajectory

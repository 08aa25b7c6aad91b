// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#include "chain_map.h"

namespace LAMMPS_NS {

/// The beads of this process, and of others those that may touch them: each process tells the others what box
/// its beads lie in and their largest radius, and gets those beads that come within reach of that box in some
/// image. LAMMPS's own ghosts do not do, which reach as far as forces want.
class NearBeads : protected Pointers {
 public:
  using Pointers::Pointers;

  struct Wanted {
    int group_bit;
    const std::vector<double>& radius_of_type;  ///< from 1 [length]; empty for the atoms' own radii
    double gap;                                 ///< [length], 0 or more
    bool everything;                            ///< whether all beads are to come here
  };

  /// Collective.
  void exchange_beads(const ChainMap& chains, const dch::Box& box, const Wanted& wanted);

  std::size_t size() const { return beads_.size(); }
  const std::vector<std::int32_t>& beads() const { return beads_; }  ///< ascending
  const std::vector<dch::Vec3>& positions() const { return positions_; }
  const std::vector<double>& radii() const { return radii_; }  ///< [length]
  /// Of a bead among those here; -1 if it is not.
  std::ptrdiff_t index_of(std::int32_t bead) const;
  bool is_own(std::size_t k) const { return own_[k]; }
  /// Of all beads of the group, on any process [length].
  double largest_radius() const { return largest_radius_; }
  std::size_t received() const { return received_; }
  bigint bytes_sent() const { return bytes_; }

 private:
  /// Fractional coordinates between which the beads of a process lie, and their largest radius. None between
  /// 1 and 0.
  struct Region {
    std::array<double, 3> low{1, 1, 1}, high{0, 0, 0};
    double radius = 0;
  };
  struct Bead {
    double bead, x, y, z, radius;  ///< as they travel
  };

  std::vector<Bead> own_beads(const ChainMap& chains, const Wanted& wanted) const;
  void take(std::vector<Bead> beads, std::size_t own);

  std::vector<std::int32_t> beads_;
  std::vector<dch::Vec3> positions_;
  std::vector<double> radii_;
  std::vector<bool> own_;
  double largest_radius_ = 0;
  std::size_t received_ = 0;
  bigint bytes_ = 0;
};

}  // namespace LAMMPS_NS

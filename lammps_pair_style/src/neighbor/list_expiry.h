// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <lammps_host.h>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/lists/stale_test.hpp>

#include "atom_points.h"
#include "ghosts_left_out.h"
#include "run_report.h"
#include "traits_at_build.h"

namespace LAMMPS_NS {

/// Says whether what was found at the last build still holds every pair within its cutoff, though atoms have
/// moved more than half the skin.
///
/// A pair within its cutoff c that the lists lack was beyond c + skin at the build. Of its two atoms one has
/// moved as far as the other or farther, by m, which is more than half the skin; so the other one is within
/// c + m of where it was, seen from where the first one is now. The process that owns the first atom asks its
/// structure, as it was at the build, for such pairs (PairSearch::unlisted_pair), and looks through the
/// ghosts that are no points. It can answer if it has had all atoms within c + m as atoms or ghosts; else,
/// and where it would cost more than a build, nobody is asked.
class ListExpiry : protected Pointers {
 public:
  using Verdict = dch::lammps::ExpiryVerdict;

  /// What the pairs of lists are that have to be there.
  struct Wanted {
    double skin;              ///< that lists were made with [length]
    bool by_types, by_radii;  ///< whose sums are cutoffs: which lists there are
    bool stays_near;  ///< no atom may be farther from its process's part of the box than half the skin
    double rounding;  ///< of distances [length]
  };

  explicit ListExpiry(LAMMPS* lammps) : Pointers(lammps), traits_(lammps) {}

  /// Lists are being made, of these points.
  /// @param may_be_asked  else judge() cannot tell
  void remember(const AtomPoints& points, bool by_radii, bool may_be_asked);
  /// What this process says of its atoms. Ghosts have to be where their owners are.
  /// @param before positions of the owned points at the build
  Verdict judge(AtomPoints& points, dch::PairSearch& search, const double* const* before,
                const Wanted& wanted);
  /// Owned atoms outside of a box that is not periodic are lost at the next build, so it has to come.
  bool any_outside() const;

 private:
  Verdict find_fast(const AtomPoints& points, const double* const* before, const Wanted& wanted);
  bool is_inside(const double* at, double reach, const double* beyond) const;
  bool is_open(int axis, bool high) const;
  bool has_changed(const AtomPoints& points) const;
  bool keeps_images(const AtomPoints& points, const Wanted& wanted) const;
  bool all_see(const AtomPoints& points, const Wanted& wanted) const;
  std::array<double, 9> box_now() const;
  dch::TypeCutoffs force_cutoffs(const Wanted& wanted) const;
  void remember_left_out(dch::Span<const int> ghosts);
  double cutoff_by_types(int a, int b, const Wanted& wanted) const;
  bool is_missing(int i, int ghost, double then2, const Wanted& wanted) const;
  bool lacks_ghost(int i, double moved, const double* before, const Wanted& wanted) const;
  dch::UnlistedPair ask(AtomPoints& points, dch::PairSearch& search, const Wanted& wanted);

  std::array<double, 9> box_{};  ///< at the build
  TraitsAtBuild traits_;
  int points_ = -1;
  std::vector<GhostsLeftOut> left_out_;  ///< by type
  std::vector<dch::MovedParticle> fast_;
};

}  // namespace LAMMPS_NS

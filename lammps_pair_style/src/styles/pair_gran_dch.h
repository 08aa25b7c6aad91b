// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(gran/hooke/dch,PairGranHookeDCH);
PairStyle(gran/hooke/history/dch,PairGranHookeHistoryDCH);
PairStyle(gran/hertz/history/dch,PairGranHertzHistoryDCH);
// clang-format on
#elif !defined(LMP_PAIR_GRAN_DCH_H)
#define LMP_PAIR_GRAN_DCH_H

#include <memory>
#include <vector>

#include <dch/forces/grain_contacts.hpp>

#include "neigh_history.h"
#include "plain_pair.h"

namespace LAMMPS_NS {

/// A granular pair style whose forces come from a SIMD kernel. Restarts are the plain style's, and so is the
/// fix that keeps the history of contacts, in which the kernel writes. Lists are those of LAMMPS, or ours in
/// their place.
///
/// The plain style computes where a fix integrates rigid bodies, whose masses count, and if LAMMPS keeps the
/// history in a way that is not known.
class PairGranDCH : public PlainPair {
 public:
  PairGranDCH(LAMMPS* lammps, const char* plain, dch::ContactForm form);

  void compute(int eflag, int vflag) override;
  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  void reset_dt() override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_restart_settings(FILE* file) override;
  void read_restart_settings(FILE* file) override;
  double atom2cut(int i) override;
  double radii2cut(double first, double second) override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 private:
  dch::lammps::Obstacle reason_for_plain();
  bool has_history() const { return form_ != dch::ContactForm::hooke; }
  void make_contacts();
  void take_list();
  void take_bodies(std::size_t grains);
  void add_contacts();

  dch::ContactForm form_;
  bool limits_damping_ = false;
  int frozen_group_ = 0;  ///< the bit of grains that never move
  double timestep_ = 0;   ///< that of the plain style
  NeighHistory history_;
  std::unique_ptr<dch::GrainContacts> contacts_;
  ContactColumns columns_;    ///< of the list
  bool has_columns_ = false;  ///< since the last setup
  bigint builds_ = 0;         ///< when they were taken
  std::vector<dch::GrainBody> bodies_;
  std::vector<dch::GrainContact> found_;
};

/// gran/hooke/dch
class PairGranHookeDCH : public PairGranDCH {
 public:
  explicit PairGranHookeDCH(LAMMPS* lammps) : PairGranDCH(lammps, "gran/hooke", dch::ContactForm::hooke) {}
};

/// gran/hooke/history/dch
class PairGranHookeHistoryDCH : public PairGranDCH {
 public:
  explicit PairGranHookeHistoryDCH(LAMMPS* lammps)
      : PairGranDCH(lammps, "gran/hooke/history", dch::ContactForm::hooke_history) {}
};

/// gran/hertz/history/dch
class PairGranHertzHistoryDCH : public PairGranDCH {
 public:
  explicit PairGranHertzHistoryDCH(LAMMPS* lammps)
      : PairGranDCH(lammps, "gran/hertz/history", dch::ContactForm::hertz_history) {}
};

}  // namespace LAMMPS_NS

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS
// clang-format off
FixStyle(necklace/crossing,FixNecklaceCrossing);
// clang-format on
#elif !defined(LMP_FIX_NECKLACE_CROSSING_H)
#define LMP_FIX_NECKLACE_CROSSING_H

#include <array>
#include <fix.h>
#include <lammps_host.h>
#include <string>
#include <vector>

#include "atom_pasts.h"
#include "crossing_finder.h"
#include "crossing_log.h"
#include "explained.h"
#include "moving_atoms.h"
#include "moving_bonds.h"

namespace LAMMPS_NS {

/// necklace/crossing: how many pairs of bonds of a group went through each other, on the straight lines from
/// where their atoms were at one check to where they are at the next.
///
/// A process that is alone looks at its atoms in the periodic box. Of several, each tests the bonds that its
/// atoms hold against those of its atoms and ghosts. No process gathers all chains.
class FixNecklaceCrossing : public Fix, public Explained {
 public:
  FixNecklaceCrossing(LAMMPS* lammps, int narg, char** arg);
  ~FixNecklaceCrossing() override;
  FixNecklaceCrossing(const FixNecklaceCrossing&) = delete;
  FixNecklaceCrossing& operator=(const FixNecklaceCrossing&) = delete;

  int setmask() override;
  dch::lammps::StyleNote explain() const override { return {"necklace/crossing", "structure of its own"}; }
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;

  double compute_scalar() override;
  double compute_vector(int n) override;
  double memory_usage() override;

  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buf) override;
  int unpack_exchange(int i, double* buf) override;
  int pack_restart(int i, double* buf) override;
  void unpack_restart(int i, int nth) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  int pack_forward_comm(int n, int* list, double* buf, int pbc_flag, int* pbc) override;
  void unpack_forward_comm(int n, int first, double* buf) override;

 private:
  enum class Action { warn, stop, count };
  /// Of all checks, over all processes.
  struct Totals {
    double crossings = 0, contacts = 0, undetermined = 0, near = 0, rejected = 0;
  };

  void read_keywords(int narg, char** arg);
  double ghost_reach() const;
  void check_ghosts() const;
  void note_box();
  dch::lammps::Cell cell() const;
  void check();
  void find(const dch::lammps::BoxStep& step);
  void add_up();
  void keep_rows();
  void act();
  void warn_of_undetermined();
  std::string text_of(const CrossingEvent& event) const;

  std::string name_;  ///< how messages begin
  Action action_ = Action::warn;
  double thickness_ = 0;
  AtomPasts pasts_;
  MovingAtoms atoms_;
  MovingBonds bonds_;
  CrossingFinder finder_;
  CrossingLog log_;
  dch::Box box_;               ///< of the middles of bonds
  dch::lammps::Cell old_box_;  ///< at the last check
  bigint old_step_ = -1;       ///< of the last check; -1 for none
  bool comm_alone_ = false;
  double reach_ = 0;  ///< that a bond's length and displacement may have together [length]
  Totals total_;
  bigint found_ = 0, undetermined_ = 0;              ///< at the last check
  double run_crossings_ = 0, run_undetermined_ = 0;  ///< totals when the run began
  bigint run_begin_ = 0;
  bool has_checked_ghosts_ = false, has_warned_ = false, has_warned_of_undetermined_ = false;
  std::vector<std::array<double, 9> > rows_;
  std::vector<double*> row_starts_;  ///< what array_local points to
};

}  // namespace LAMMPS_NS

#endif

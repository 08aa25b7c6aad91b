// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <fix.h>
#include <lammps_host.h>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class Compute;

/// Keeps, with each atom, the work of the last lists (NeighborDCH::count_work), so that it goes where the
/// atom goes: by migration, sorting, deletion. Not for input scripts; a compute dch/work makes one.
class FixDCHWork : public Fix {
 public:
  static constexpr const char* kStyle = "DCH_WORK";
  static constexpr double kOwn = 1;  ///< work of an atom without neighbors, or that no list has known

  FixDCHWork(LAMMPS* lammps, int narg, char** arg);
  ~FixDCHWork() override;
  FixDCHWork(const FixDCHWork&) = delete;
  FixDCHWork& operator=(const FixDCHWork&) = delete;

  /// One for this compute, whose vector by atom is the work kept.
  /// @param id of the fix
  static void install(LAMMPS* lammps, const std::string& id, Compute& reader);
  /// Between runs LAMMPS reads computes only of which it knows that they are of this step, which it forgets
  /// at the beginning of each command like `balance`. To be called after Modify::init().
  static void note_current(LAMMPS* lammps);

  int setmask() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void post_neighbor() override;
  void min_post_neighbor() override { post_neighbor(); }
  void post_run() override { note_reader_current(); }

  void grow_arrays(int nmax) override;
  void copy_arrays(int i, int j, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buf) override;
  int unpack_exchange(int i, double* buf) override;
  int pack_reverse_comm(int n, int first, double* buf) override;
  void unpack_reverse_comm(int n, int* atoms, double* buf) override;
  double memory_usage() override;

 private:
  double& of(int i) { return work_[static_cast<std::size_t>(i)]; }
  void note_reader_current();

  std::vector<double> work_;  ///< by atom
  Compute* reader_ = nullptr;
};

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lammps_host.h>
#include <memory>
#include <pair.h>
#include <string>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "cluster_list.h"
#include "explained.h"

namespace LAMMPS_NS {

/// A pair style computed on cluster pairs, as which it is found by `suffix dch`; everything but the forces is
/// the plain style's, of which it keeps an object: arguments, coefficients, mixing, tail corrections,
/// restarts, single().
///
/// With r-RESPA that splits the forces of pairs into levels the plain style computes, on its own lists.
///
/// Ordinary pairs go through a SIMD kernel. Bonded pairs with weights, steps that want energies by atom or
/// other tallies, and newton off with ghosts go pair by pair through the plain style's single(). Where
/// cluster pairs cannot be had (settings that dch stats names) the plain style computes, on a neighbor list.
/// Wherever it computes, it does so without its tables of Coulomb forces, as the kernels do.
class PairDCH : public Pair, public Explained {
 public:
  /// @param plain name of the plain style
  PairDCH(LAMMPS* lammps, std::string plain);
  ~PairDCH() override;
  PairDCH(const PairDCH&) = delete;
  PairDCH& operator=(const PairDCH&) = delete;

  void compute(int eflag, int vflag) override;
  void compute_inner() override;
  void compute_middle() override;
  void compute_outer(int eflag, int vflag) override;
  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  void init_list(int id, NeighList* neighbors) override;
  double init_one(int i, int j) override;
  void modify_params(int narg, char** arg) override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_restart_settings(FILE* file) override;
  void read_restart_settings(FILE* file) override;
  void write_data(FILE* file) override;
  void write_data_all(FILE* file) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                double& fforce) override;
  void* extract(const char* name, int& dimension) override;
  void add_tally_callback(Compute* compute) override;
  void del_tally_callback(Compute* compute) override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  /// Pairs of types, from 1, that this style computes with coefficients as they are now.
  struct PairOfTypes {
    int a, b;
    double cutoff;  ///< [length]
  };

  /// Makes the kernel for these pairs of types.
  virtual void make_kernel(const std::vector<PairOfTypes>& pairs) = 0;
  /// Adds forces and, if wanted, adds to eng_vdwl, eng_coul and virial.
  virtual void add_forces(const ClusterList& wanted, dch::ForcePrecision precision,
                          dch::Span<dch::Vec3> forces, bool with_sums) = 0;
  /// As the kernels want them, of the points of the list.
  dch::Span<const dch::Vec3> positions(const ClusterList& wanted) const;
  dch::Box box(const ClusterList& wanted) const;

  /// Whether the plain style's energies have a Coulomb part.
  virtual bool has_charges() const { return false; }

  Pair& plain() const { return *plain_; }
  bool shifts_energy() const { return offset_flag != 0; }

 private:
  dch::lammps::Obstacle reason_for_plain() const;
  bool may_have_levels() const;
  Pair& plain_of_levels() const;
  std::string way() const;
  void take_flags();
  void take_coefficients();
  void prepare_kernel();
  void refresh();
  void take_sums_of_plain();
  void compute_clusters(bool with_sums);
  void compute_pair_by_pair();
  void compute_special();
  void compute_one(int i, int j, dch::Vec3 from_j_to_i, double factor_lj, double factor_coul);

  std::string plain_name_;
  std::unique_ptr<Pair> plain_;
  std::shared_ptr<ClusterList> clusters_;         ///< null if the plain style computes
  dch::lammps::Obstacle obstacle_;                ///< why it does
  bool has_lists_of_plain_ = false;               ///< those that the plain style has asked for
  std::int64_t computed_ = 0, pair_by_pair_ = 0;  ///< in this run: how often, and how often by single()
  std::vector<PairOfTypes> pairs_of_types_;
  bool has_kernel_ = false;           ///< for the coefficients as they are
  std::vector<dch::Vec3> of_ghosts_;  ///< forces on ghosts before ours
};

}  // namespace LAMMPS_NS

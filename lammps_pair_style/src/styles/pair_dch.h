// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/forces/pair_potential.hpp>

#include "cluster_list.h"
#include "plain_pair.h"

namespace LAMMPS_NS {

/// A pair style computed on cluster pairs, as which it is found by `suffix dch`; everything but the forces is
/// the plain style's, of which it keeps an object: arguments, coefficients, mixing, tail corrections,
/// restarts, single().
///
/// With r-RESPA that splits the forces of pairs into levels the plain style computes, on its lists.
///
/// Pairs go through a SIMD kernel, weighted ones of bonded atoms too; a style says what it is made of. The
/// kernel tallies energies and virials by atom at steps that want these, and where newton is off and there
/// are ghosts, of whose pairs only the owned atoms' halves belong into sums. Computes that ask for each pair
/// have them computed one by one. Where cluster pairs cannot be had (settings that dch stats names) the plain
/// style computes, on a neighbor list. Wherever it computes, it does so without its tables of Coulomb forces,
/// as the kernels do.
class PairDCH : public PlainPair {
 public:
  /// What a style is made of.
  struct Style {
    const char* plain;  ///< the plain style's name
    dch::PairForm form;
    dch::ChargeForm charges;
    int numbers;           ///< how many the plain style writes to restart files for a pair of types
    bool by_rows = false;  ///< whether the kernel computes pairs one by one row by row
  };

  PairDCH(LAMMPS* lammps, const Style& style);

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
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  using PairsOfTypes = std::vector<std::pair<int, int>>;  ///< from 1

  /// After what the script says of the plain style has changed.
  void take_coefficients();
  /// Why the plain style has to compute, as far as its settings say; asked at the beginning of each run.
  virtual dch::lammps::Obstacle obstacle_of_settings() { return {}; }
  /// The form's numbers of these pairs of types, from the plain style's restart data by the next two.
  virtual void take_numbers(const PairsOfTypes& given, dch::PairPotentialParams& params) const;
  /// What the plain style writes to restart files before pairs of types says of the potential; charges that
  /// act by an Ewald sum know their splitting.
  virtual void take_all(const double*, dch::PairPotentialParams&) const {}
  /// The same of a pair of types.
  /// @param all  what take_all() gets
  virtual void take_pair(const double* all, const double* own, dch::FormPair& pair) const;
  /// What the kernel is made of.
  dch::PairPotentialParams kernel_params() const;
  /// Called when forces have been added.
  virtual void check_forces() {}
  /// Whether all forces on owned atoms are, those of other styles included.
  bool forces_are_finite() const;
  /// Owned atom, the other, vector from the latter, kind of bonded pair or 0.
  using PairVisitor = std::function<void(int, int, dch::Vec3, int)>;
  /// Visits each pair within its cutoff.
  void for_each_pair(const PairVisitor& visit) const;

 private:
  /// Pairs of types, from 1, that this style computes with coefficients as they are now.
  struct PairOfTypes {
    int a, b;
    double cutoff;  ///< [length]
  };
  struct Batch;

  dch::lammps::Obstacle reason_for_plain() const;
  bool may_have_levels() const;
  void take_requests(int first);
  Pair& plain_of_levels() const;
  std::string way() const;
  void take_flags();
  void refresh();
  void compute_clusters();
  void give_tallies();
  dch::LennardJonesSums sums_of_tallies() const;
  void compute_pair_by_pair();
  void add_self_energies(bool by_atom);
  void finish(Batch& batch);
  bool has_charges() const { return style_.charges != dch::ChargeForm::none; }
  dch::Span<const double> charges() const;
  std::array<double, 4> weights(const double* special) const;
  dch::Span<const dch::Vec3> positions() const;
  dch::Box box() const;

  Style style_;
  std::shared_ptr<ClusterList> clusters_;  ///< null if the plain style computes
  bool has_lists_of_plain_ = false;        ///< those that the plain style has asked for
  std::int64_t pair_by_pair_ = 0;          ///< how often in this run
  std::vector<PairOfTypes> pairs_of_types_;
  std::unique_ptr<dch::PairPotential> kernel_;  ///< null unless for the coefficients as they are
  std::vector<dch::Vec3> of_ghosts_;            ///< forces on ghosts before ours
  std::vector<dch::LennardJonesSums> tallies_;  ///< by point; none unless wanted
};

}  // namespace LAMMPS_NS

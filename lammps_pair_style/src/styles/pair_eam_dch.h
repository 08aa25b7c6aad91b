// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(eam/dch,PairEAMDCH);
PairStyle(eam/alloy/dch,PairEAMAlloyDCH);
PairStyle(eam/fs/dch,PairEAMFSDCH);
// clang-format on
#elif !defined(LMP_PAIR_EAM_DCH_H)
#define LMP_PAIR_EAM_DCH_H

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/forces/embedded_atoms.hpp>

#include "eam_file.h"
#include "plain_pair.h"

namespace LAMMPS_NS {

/// Embedded atoms, whose densities and forces come from SIMD kernels. The plain style keeps its functions to
/// itself, in a class whose header LAMMPS does not install, so files are read once more. Lists are those of
/// LAMMPS, or ours in their place.
///
/// The plain style computes with files that are not understood or whose units it changes, and at steps at
/// which `fix adapt` scales the potential.
class PairEAMDCH : public PlainPair {
 public:
  explicit PairEAMDCH(LAMMPS* lammps) : PairEAMDCH(lammps, "eam", dch::lammps::EamFormat::funcfl) {}

  void compute(int eflag, int vflag) override;
  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  double init_one(int i, int j) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                double& fforce) override;
  int pack_forward_comm(int n, int* atoms, double* to, int pbc_flag, int* pbc) override;
  void unpack_forward_comm(int n, int first, double* from) override;
  int pack_reverse_comm(int n, int first, double* to) override;
  void unpack_reverse_comm(int n, int* atoms, double* from) override;
  double memory_usage() override;
  dch::lammps::StyleNote explain() const override;

 protected:
  PairEAMDCH(LAMMPS* lammps, const char* plain, dch::lammps::EamFormat format);

 private:
  std::string text_of(const std::string& file) const;
  dch::lammps::Obstacle reason_for_plain() const;
  bool is_scaled() const;
  dch::NeighborRows rows() const;
  void add_densities();
  void embed();
  void add_forces();

  dch::lammps::EamFormat format_;
  std::vector<dch::lammps::EamFile> files_;
  dch::lammps::EamTypes of_types_;
  double cutoff_ = 0;
  std::unique_ptr<dch::EmbeddedAtoms> atoms_;
  std::int64_t scaled_ = 0;   ///< times in this run by the plain style, as it was scaled
  bool is_by_plain_ = false;  ///< the last time
  std::vector<double> densities_, slopes_;
};

/// eam/alloy/dch
class PairEAMAlloyDCH : public PairEAMDCH {
 public:
  explicit PairEAMAlloyDCH(LAMMPS* lammps) : PairEAMDCH(lammps, "eam/alloy", dch::lammps::EamFormat::setfl) {}
};

/// eam/fs/dch
class PairEAMFSDCH : public PairEAMDCH {
 public:
  explicit PairEAMFSDCH(LAMMPS* lammps)
      : PairEAMDCH(lammps, "eam/fs", dch::lammps::EamFormat::finnis_sinclair) {}
};

}  // namespace LAMMPS_NS

#endif

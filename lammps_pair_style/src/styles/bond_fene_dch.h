// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef BOND_CLASS
// clang-format off
BondStyle(fene/dch,BondFENEDCH);
// clang-format on
#elif !defined(LMP_BOND_FENE_DCH_H)
#define LMP_BOND_FENE_DCH_H

#include <array>
#include <bond.h>
#include <lammps_host.h>
#include <memory>
#include <vector>

#include <dch/forces/fene.hpp>

namespace LAMMPS_NS {

/// fene/dch: forces by a SIMD kernel. Everything else is the plain style's, of which it keeps an object,
/// which also computes at steps that want energy or virials by atom, and always if newton is off for bonds.
class BondFENEDCH : public Bond {
 public:
  explicit BondFENEDCH(LAMMPS* lammps);
  ~BondFENEDCH() override;
  BondFENEDCH(const BondFENEDCH&) = delete;
  BondFENEDCH& operator=(const BondFENEDCH&) = delete;

  void init_style() override;
  void compute(int eflag, int vflag) override;
  void coeff(int narg, char** arg) override;
  double equilibrium_distance(int type) override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_data(FILE* file) override;
  double single(int type, double rsq, int i, int j, double& fforce) override;
  void* extract(const char* name, int& dimension) override;
  void reinit() override;
  double memory_usage() override;

 private:
  void take_coefficients();
  void make_kernel();
  void compute_plain(int eflag, int vflag);
  void add_long_bond(const dch::BondOfType& bond, std::array<double, 6>& sums);

  std::unique_ptr<Bond> plain_;
  std::unique_ptr<dch::FeneForces> kernel_;  ///< null if coefficients have changed
  std::vector<std::int32_t> too_long_;
};

}  // namespace LAMMPS_NS

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(dpd/philox,PairDPDPhilox);
PairStyle(dpd/tstat/philox,PairDPDTstatPhilox);
// clang-format on
#elif !defined(LMP_PAIR_DPD_PHILOX_H)
#define LMP_PAIR_DPD_PHILOX_H

#include <cstdint>
#include <lammps_host.h>
#include <memory>
#include <pair.h>
#include <string>
#include <vector>

#include <dch/forces/dissipative_pairs.hpp>

#include "explained.h"

namespace LAMMPS_NS {

/// dpd/philox: the forces of pair_style dpd, on neighbor lists, with random numbers that depend on seed, IDs
/// of both atoms and step alone. It needs no plain style, and `suffix dch` does not find it, as it takes
/// other numbers than dpd.
class PairDPDPhilox : public Pair, public Explained {
 public:
  explicit PairDPDPhilox(LAMMPS* lammps) : PairDPDPhilox(lammps, "dpd/philox", true) {}
  ~PairDPDPhilox() override;
  PairDPDPhilox(const PairDPDPhilox&) = delete;
  PairDPDPhilox& operator=(const PairDPDPhilox&) = delete;

  void compute(int eflag, int vflag) override;
  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  double init_one(int i, int j) override;
  void write_restart(FILE* file) override;
  void read_restart(FILE* file) override;
  void write_restart_settings(FILE* file) override;
  void read_restart_settings(FILE* file) override;
  void write_data(FILE* file) override;
  void write_data_all(FILE* file) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                double& fforce) override;
  dch::lammps::StyleNote explain() const override {
    return {"pair " + style_, "SIMD kernel on a neighbor list, random numbers by seed, atom IDs and step"};
  }

 protected:
  /// @param repels whether there is a repulsion beside drag and random forces, as of dpd but not of dpd/tstat
  PairDPDPhilox(LAMMPS* lammps, const char* style, bool repels);

 private:
  struct Batch;

  std::string title() const { return "Pair style " + style_ + ": "; }
  dch::DissipativePair& of_types(int a, int b);
  void make_room();
  double number(const char* word, const char* what, double least) const;
  double temperature() const;
  void take_coefficients();
  void check_box() const;
  template <bool kOneType>
  int find_near(int i);
  void add_row(int i, Batch& batch);
  void finish(Batch& batch);

  std::string style_;
  bool repels_;
  double start_ = 0, stop_ = 0;  ///< temperatures
  double cutoff_ = 0;            ///< of pairs of types without one of their own [length]
  int seed_ = 0;
  std::vector<dch::DissipativePair> given_;        ///< by pair of types, from 0
  std::unique_ptr<dch::DissipativePairs> forces_;  ///< null unless for the coefficients as they are
  std::vector<int> near_;                          ///< neighbors within the cutoff of the row at hand
};

/// dpd/tstat/philox: drag and random forces alone, as those of pair_style dpd/tstat.
class PairDPDTstatPhilox : public PairDPDPhilox {
 public:
  explicit PairDPDTstatPhilox(LAMMPS* lammps) : PairDPDPhilox(lammps, "dpd/tstat/philox", false) {}
};

}  // namespace LAMMPS_NS

#endif

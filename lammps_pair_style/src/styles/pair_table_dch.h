// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef PAIR_CLASS
// clang-format off
PairStyle(table/dch,PairTableDCH);
// clang-format on
#elif !defined(LMP_PAIR_TABLE_DCH_H)
#define LMP_PAIR_TABLE_DCH_H

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pair_dch.h"

namespace LAMMPS_NS {

/// table/dch, whose tables are those of `pair_style table linear` and `spline`. The plain style keeps them to
/// itself and writes none to restart files, so its single() is asked between the distances where a table
/// begins, which its file tells, and ends, the cutoff. Two atoms that are closer than a table begins have no
/// number as their force, and then the plain style is asked about each pair, which stops the run with its
/// message.
class PairTableDCH : public PairDCH {
 public:
  explicit PairTableDCH(LAMMPS* lammps)
      : PairDCH(lammps, {"table", dch::PairForm::table, dch::ChargeForm::none, 0}) {}

  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void read_restart(FILE* file) override;
  void read_restart_settings(FILE* file) override;

 private:
  /// What one pair_coeff has given.
  struct Given {
    double inner;          ///< where the table begins; 0 if its file does not tell [length]
    dch::PairTable knots;  ///< none until the plain style is asked
  };

  void forget();
  double first_distance(const std::string& file, const std::string& keyword) const;
  bool ask_for_knots(int a, int b, bool is_spline, int length, Given& given);
  dch::lammps::Obstacle obstacle_of_settings() override;
  void take_numbers(const PairsOfTypes& given, dch::PairPotentialParams& params) const override;
  void check_forces() override;

  std::vector<Given> given_;
  std::map<std::pair<int, int>, std::size_t> given_of_types_;
};

}  // namespace LAMMPS_NS

#endif

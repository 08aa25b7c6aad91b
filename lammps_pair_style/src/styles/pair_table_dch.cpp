// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_table_dch.h"

#include <algorithm>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <cstring>
#include <error.h>
#include <fstream>
#include <utils.h>

#include "restart_numbers.h"
#include "table_file.h"
#include "table_knots.h"

namespace LAMMPS_NS {
namespace {

/// In the order in which the plain style counts them in restart files.
constexpr const char* kWays[] = {"lookup", "linear", "spline", "bitmap"};
constexpr int kLinear = 1, kSpline = 2;

}  // namespace

void PairTableDCH::forget() {
  given_.clear();
  given_of_types_.clear();
  ewaldflag = plain().ewaldflag;
  pppmflag = plain().pppmflag;
  msmflag = plain().msmflag;
  dispersionflag = plain().dispersionflag;
  tip4pflag = plain().tip4pflag;
}

void PairTableDCH::settings(int narg, char** arg) {
  PairDCH::settings(narg, arg);
  forget();
}

void PairTableDCH::read_restart(FILE* file) {
  PairDCH::read_restart(file);
  forget();
}

void PairTableDCH::read_restart_settings(FILE* file) {
  PairDCH::read_restart_settings(file);
  forget();
}

/// Flags of pairs of types tell which of them this command is for.
void PairTableDCH::coeff(int narg, char** arg) {
  PairsOfTypes before;
  const auto for_each_set = [this](const auto& visit) {
    if (!plain().allocated) return;
    for (int a = 1; a <= atom->ntypes; ++a)
      for (int b = a; b <= atom->ntypes; ++b)
        if (plain().setflag[a][b]) visit(a, b);
  };
  for_each_set([&](int a, int b) {
    before.emplace_back(a, b);
    plain().setflag[a][b] = 0;
  });
  plain().coeff(narg, arg);
  for_each_set([&](int a, int b) { given_of_types_[{a, b}] = given_.size(); });
  given_.push_back({first_distance(arg[2], arg[3]), {}});
  for (const auto& [a, b] : before) plain().setflag[a][b] = 1;
  take_coefficients();
}

/// Process 0 reads the file, as it does for the plain style.
double PairTableDCH::first_distance(const std::string& file, const std::string& keyword) const {
  double found = 0;
  if (comm->me == 0) {
    std::ifstream opened(utils::get_potential_file_path(file));
    found = dch::lammps::first_distance(opened, keyword);
  }
  MPI_Bcast(&found, 1, MPI_DOUBLE, 0, world);
  return found;
}

/// @returns whether the plain style's table is what it is thought to be
bool PairTableDCH::ask_for_knots(int a, int b, bool is_spline, int length, Given& given) {
  given.knots.inner = given.inner;
  given.knots.outer = plain().init_one(a, b);
  if (!(given.knots.inner < given.knots.outer)) return false;
  const dch::lammps::AskTable ask = [this, a, b](double r2) {
    dch::lammps::TablePoint at;
    at.energy = plain().single(0, 0, a, b, r2, 1, 1, at.force_over_r);
    return at;
  };
  return is_spline ? dch::lammps::take_splines(ask, length, given.knots)
                   : dch::lammps::take_lines(ask, length, given.knots);
}

dch::lammps::Obstacle PairTableDCH::obstacle_of_settings() {
  if (ewaldflag || pppmflag || msmflag || dispersionflag || tip4pflag)
    return {"tables for a long-range solver", "no keyword of a solver in the pair_style"};
  const std::string settings = restart_settings(plain());
  int numbers[2] = {-1, 0};  // how a table is read, and its length
  if (settings.size() >= sizeof numbers) std::memcpy(numbers, settings.data(), sizeof numbers);
  const auto [way, length] = numbers;
  if (way != kLinear && way != kSpline)
    return {std::string("pair_style table ") + (way >= 0 && way < 4 ? kWays[way] : "of an unknown kind"),
            "'pair_style table linear N' or 'pair_style table spline N'"};
  for (const auto& [types, k] : given_of_types_) {
    Given& given = given_[k];
    if (!given.knots.energy.empty()) continue;
    if (given.inner == 0)
      return {"a file does not tell where its table begins", "a file with one distance a line"};
    if (!ask_for_knots(types.first, types.second, way == kSpline, length, given)) {
      given.knots = {};
      return {way == kSpline ? "a table of pair_style table spline that is no cubic spline of r^2"
                             : "a table of pair_style table linear that is not linear in r^2",
              "'pair_style table/stock'"};
    }
  }
  return {};
}

void PairTableDCH::take_numbers(const PairsOfTypes& given, dch::PairPotentialParams& params) const {
  const auto n = static_cast<std::size_t>(atom->ntypes);
  std::map<std::size_t, std::size_t> numbers;  // of tables that are used
  for (const auto& [a, b] : given) {
    const std::size_t k = given_of_types_.at({a, b});
    const auto [entry, is_new] = numbers.emplace(k, params.tables.size());
    if (is_new) params.tables.push_back(given_[k].knots);
    if (!given_[k].knots.energy_bend.empty()) params.form = dch::PairForm::spline;
    dch::FormPair pair;
    pair.numbers[0] = static_cast<double>(entry->second);
    pair.cutoff = given_[k].knots.outer;
    const auto row = static_cast<std::size_t>(a - 1), column = static_cast<std::size_t>(b - 1);
    params.pairs[row * n + column] = params.pairs[column * n + row] = pair;
  }
}

void PairTableDCH::check_forces() {
  if (forces_are_finite()) return;
  // Other forces may be no numbers too. Rounding in single precision may have brought a pair closer than it
  // is.
  for_each_pair([&](int i, int j, dch::Vec3 apart, int) {
    const int a = std::min(atom->type[i], atom->type[j]), b = std::max(atom->type[i], atom->type[j]);
    const dch::PairTable& knots = given_[given_of_types_.at({a, b})].knots;
    const double r2 = norm2(apart);
    if (!(std::sqrt(r2) < (1 + 1e-6) * knots.inner + 1e-7 * knots.outer)) return;
    double of_pair = 0;
    plain().single(i, j, a, b, r2, 1, 1, of_pair);
    error->one(FLERR, std::string("Pair distance < table inner cutoff, to within rounding"));
  });
}

}  // namespace LAMMPS_NS

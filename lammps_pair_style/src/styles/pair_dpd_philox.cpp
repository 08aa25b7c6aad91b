// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_dpd_philox.h"

#include <algorithm>
#include <array>
#include <atom.h>
#include <cmath>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <force.h>
#include <memory.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <update.h>
#include <utils.h>

#include <dch/base/error.hpp>

#include "finite_number.h"
#include "plain_pair.h"

namespace LAMMPS_NS {

PairDPDPhilox::PairDPDPhilox(LAMMPS* lammps, const char* style, bool repels)
    : Pair(lammps), style_(style), repels_(repels) {
  writedata = 1;
  single_enable = repels ? 1 : 0;
}

PairDPDPhilox::~PairDPDPhilox() {
  if (!copymode) give_up_arrays_by_types(*this, *memory);
}

// --------------------------------------------------------------------------------------------------------------------
// What a script says

/// A word of the script.
double PairDPDPhilox::number(const char* word, const char* what, double least) const {
  const double value = finite_number(word);
  if (!(value >= least))
    error->all(FLERR, title() + "the " + what + " is '" + word + "' but has to be a number" +
                          (least == 0 ? " of 0 or more" : ""));
  return value;
}

void PairDPDPhilox::settings(int narg, char** arg) {
  const int temperatures = repels_ ? 1 : 2;
  if (narg != temperatures + 2)
    error->all(FLERR, title() + (repels_ ? "a temperature" : "two temperatures") +
                          ", a cutoff and a seed are wanted, but " + std::to_string(narg) +
                          " words given; for example 'pair_style " + style_ +
                          (repels_ ? " 1.0 1.0 904297'" : " 1.0 1.0 1.0 904297'"));
  start_ = number(arg[0], "temperature", 0);
  stop_ = number(arg[temperatures - 1], "temperature", 0);
  cutoff_ = number(arg[temperatures], "cutoff", 0);
  const double seed = finite_number(arg[temperatures + 1]);
  if (!(seed >= 1 && seed <= MAXSMALLINT && seed == std::floor(seed)))
    error->all(FLERR, title() + "the seed is '" + arg[temperatures + 1] +
                          "' but has to be a whole number from 1 to 2147483647");
  seed_ = static_cast<int>(seed);
  for (dch::DissipativePair& pair : given_) pair.cutoff = cutoff_;
  forces_.reset();
}

dch::DissipativePair& PairDPDPhilox::of_types(int a, int b) {
  return given_[static_cast<std::size_t>((a - 1) * atom->ntypes + b - 1)];
}

void PairDPDPhilox::make_room() {
  if (allocated) return;
  const int n = atom->ntypes;
  make_arrays_by_types(*this, n, *memory);
  for (int a = 1; a <= n; ++a)
    for (int b = 1; b <= n; ++b) setflag[a][b] = 0;
  given_.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), {0, 0, cutoff_});
}

void PairDPDPhilox::coeff(int narg, char** arg) {
  const int least = repels_ ? 4 : 3;
  if (narg != least && narg != least + 1)
    error->all(FLERR, title() + "pair_coeff wants two types, " + (repels_ ? "repulsion, " : "") +
                          "friction and perhaps a cutoff, but has " + std::to_string(narg) + " words");
  make_room();
  int first_a, last_a, first_b, last_b;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, first_a, last_a, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, first_b, last_b, error);
  dch::DissipativePair pair;
  if (repels_) pair.repulsion = number(arg[2], "repulsion", -HUGE_VAL);
  pair.friction = number(arg[least - 1], "friction", 0);
  pair.cutoff = narg > least ? number(arg[least], "cutoff", 0) : cutoff_;
  int count = 0;
  for (int a = first_a; a <= last_a; ++a)
    for (int b = std::max(first_b, a); b <= last_b; ++b, ++count) {
      of_types(a, b) = of_types(b, a) = pair;
      setflag[a][b] = 1;
    }
  if (count == 0)
    error->all(FLERR, title() + "pair_coeff " + arg[0] + " " + arg[1] +
                          " names no pair of types; give the smaller type first");
  forces_.reset();
}

void PairDPDPhilox::init_style() {
  if (!comm->ghost_velocity)
    error->all(FLERR, title() + "drag needs velocities of ghosts; give 'comm_modify vel yes'");
  if (!atom->tag_enable)
    error->all(FLERR,
               title() + "atoms have no IDs, on which random numbers depend; give 'atom_modify id yes'");
  neighbor->request(this, instance_me);
}

double PairDPDPhilox::init_one(int i, int j) {
  if (!setflag[i][j])
    error->all(FLERR, title() + "types " + std::to_string(i) + " and " + std::to_string(j) +
                          " have no pair_coeff; there is no mixing");
  forces_.reset();
  return of_types(i, j).cutoff;
}

// --------------------------------------------------------------------------------------------------------------------
// Files

void PairDPDPhilox::write_restart_settings(FILE* file) {
  const std::array<double, 3> numbers{start_, stop_, cutoff_};
  std::fwrite(numbers.data(), sizeof numbers, 1, file);
  std::fwrite(&seed_, sizeof seed_, 1, file);
}

void PairDPDPhilox::read_restart_settings(FILE* file) {
  std::array<double, 3> numbers{};
  if (comm->me == 0) {
    utils::sfread(FLERR, numbers.data(), sizeof numbers, 1, file, nullptr, error);
    utils::sfread(FLERR, &seed_, sizeof seed_, 1, file, nullptr, error);
  }
  MPI_Bcast(numbers.data(), 3, MPI_DOUBLE, 0, world);
  MPI_Bcast(&seed_, 1, MPI_INT, 0, world);
  start_ = numbers[0];
  stop_ = numbers[1];
  cutoff_ = numbers[2];
}

void PairDPDPhilox::write_restart(FILE* file) {
  write_restart_settings(file);
  for (int a = 1; a <= atom->ntypes; ++a)
    for (int b = a; b <= atom->ntypes; ++b) {
      std::fwrite(&setflag[a][b], sizeof(int), 1, file);
      std::fwrite(&of_types(a, b), sizeof(dch::DissipativePair), 1, file);
    }
}

void PairDPDPhilox::read_restart(FILE* file) {
  read_restart_settings(file);
  make_room();
  for (int a = 1; a <= atom->ntypes; ++a)
    for (int b = a; b <= atom->ntypes; ++b) {
      dch::DissipativePair& pair = of_types(a, b);
      if (comm->me == 0) {
        utils::sfread(FLERR, &setflag[a][b], sizeof(int), 1, file, nullptr, error);
        utils::sfread(FLERR, &pair, sizeof pair, 1, file, nullptr, error);
      }
      MPI_Bcast(&setflag[a][b], 1, MPI_INT, 0, world);
      MPI_Bcast(&pair, sizeof pair, MPI_BYTE, 0, world);
      of_types(b, a) = pair;
    }
  forces_.reset();
}

void PairDPDPhilox::write_data(FILE* file) {
  for (int a = 1; a <= atom->ntypes; ++a) {
    const dch::DissipativePair& pair = of_types(a, a);
    if (repels_)
      std::fprintf(file, "%d %.15g %.15g\n", a, pair.repulsion, pair.friction);
    else
      std::fprintf(file, "%d %.15g\n", a, pair.friction);
  }
}

void PairDPDPhilox::write_data_all(FILE* file) {
  for (int a = 1; a <= atom->ntypes; ++a)
    for (int b = a; b <= atom->ntypes; ++b) {
      const dch::DissipativePair& pair = of_types(a, b);
      if (repels_)
        std::fprintf(file, "%d %d %.15g %.15g %.15g\n", a, b, pair.repulsion, pair.friction, pair.cutoff);
      else
        std::fprintf(file, "%d %d %.15g %.15g\n", a, b, pair.friction, pair.cutoff);
    }
}

}  // namespace LAMMPS_NS

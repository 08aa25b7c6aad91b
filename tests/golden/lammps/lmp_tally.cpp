// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch with a compute that pairs are shown to one by one, as those of LAMMPS's package TALLY:
//     lmp_tally [LAMMPS options]
//     compute ID all each/pair
// It has the energy of all pairs and, as a vector, their virial: xx, yy, zz, xy, xz, yz. Of a pair that
// another process sees too it takes half.
#include <algorithm>
#include <array>
#include <compute.h>
#include <error.h>
#include <force.h>
#include <input.h>
#include <lammps_host.h>
#include <memory>
#include <modify.h>
#include <pair.h>
#include <string>
#include <update.h>

#include "dch_register.h"

namespace LAMMPS_NS {
namespace {

class ComputeEachPair : public Compute {
 public:
  ComputeEachPair(LAMMPS* lammps, int narg, char** arg) : Compute(lammps, narg, arg) {
    scalar_flag = vector_flag = timeflag = peflag = pressflag = 1;
    size_vector = 6;
    extscalar = extvector = 1;
    vector = virial_.data();
  }
  ~ComputeEachPair() override {
    if (force && force->pair) force->pair->del_tally_callback(this);
  }
  void init() override {
    if (!force->pair) error->all(FLERR, std::string("compute each/pair needs a pair style"));
    force->pair->add_tally_callback(this);
  }
  void pair_setup_callback(int, int) override { own_.fill(0); }
  void pair_tally_callback(int i, int j, int nlocal, int newton, double of_form, double of_charges,
                           double force_over_r, double dx, double dy, double dz) override {
    const double share = newton ? 1 : 0.5 * (i < nlocal ? 1 : 0) + 0.5 * (j < nlocal ? 1 : 0);
    const double products[] = {dx * dx, dy * dy, dz * dz, dx * dy, dx * dz, dy * dz};
    own_[6] += share * (of_form + of_charges);
    for (std::size_t k = 0; k < 6; ++k) own_[k] += share * force_over_r * products[k];
  }
  double compute_scalar() override {
    invoked_scalar = update->ntimestep;
    MPI_Allreduce(&own_[6], &scalar, 1, MPI_DOUBLE, MPI_SUM, world);
    return scalar;
  }
  void compute_vector() override {
    invoked_vector = update->ntimestep;
    MPI_Allreduce(own_.data(), virial_.data(), 6, MPI_DOUBLE, MPI_SUM, world);
  }

 private:
  std::array<double, 7> own_{};
  std::array<double, 6> virial_{};
};

Compute* create(LAMMPS* lammps, int narg, char** arg) { return new ComputeEachPair(lammps, narg, arg); }

}  // namespace
}  // namespace LAMMPS_NS

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
  if (dch_register(lammps.get()) != 0) return 1;
  (*lammps->modify->compute_map)["each/pair"] = LAMMPS_NS::create;
  lammps->input->file();
  lammps.reset();
  MPI_Finalize();
  return 0;
}

// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch: LAMMPS with the command `dch`, and LAMMPS's own command line.
#include <exception>
#include <input.h>
#include <lammps_host.h>
#include <library.h>
#include <memory>

#include "dch_register.h"

namespace {

int run(int argc, char** argv) {
  const auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
  const int status = dch_register(lammps.get());
  if (status == 0) lammps->input->file();
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    status = run(argc, argv);
  } catch (const std::exception&) {
    MPI_Abort(MPI_COMM_WORLD, 1);  // builds of LAMMPS with exceptions throw once their message is out
  }
  lammps_python_finalize();
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Finalize();
  return status;
}

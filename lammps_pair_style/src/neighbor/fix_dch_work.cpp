// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_dch_work.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <compute.h>
#include <cstring>
#include <modify.h>
#include <update.h>

#include "lammps_versions.h"
#include "neighbor_dch.h"

namespace LAMMPS_NS {

FixDCHWork::FixDCHWork(LAMMPS* lammps, int narg, char** arg) : Fix(lammps, narg, arg) {
  create_attribute = 1;  // set_arrays() for atoms that commands make
  maxexchange = 1;
  comm_reverse = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixDCHWork::~FixDCHWork() { atom->delete_callback(id, Atom::GROW); }

void FixDCHWork::install(LAMMPS* lammps, const std::string& id, Compute& reader) {
  Modify& modify = *lammps->modify;
  (*modify.fix_map)[kStyle] = [](LAMMPS* lmp, int narg, char** arg) -> Fix* {
    return new FixDCHWork(lmp, narg, arg);
  };
  modify.add_fix(id + " all " + kStyle, 0);
  auto* const made = static_cast<FixDCHWork*>(modify.fix[modify.find_fix(id)]);
  made->reader_ = &reader;
  reader.vector_atom = made->work_.data();
}

void FixDCHWork::note_current(LAMMPS* lammps) {
  const Modify& modify = *lammps->modify;
  for (int k = 0; k < modify.nfix; ++k)
    if (std::strcmp(modify.fix[k]->style, kStyle) == 0)
      static_cast<FixDCHWork*>(modify.fix[k])->note_reader_current();
}

void FixDCHWork::note_reader_current() { reader_->invoked_peratom = update->ntimestep; }

int FixDCHWork::setmask() { return FixConst::POST_NEIGHBOR | FixConst::MIN_POST_NEIGHBOR; }

void FixDCHWork::post_neighbor() {
  std::fill_n(work_.begin(), atom->nlocal, kOwn);
  std::fill_n(work_.begin() + atom->nlocal, atom->nghost, 0.0);
  if (const auto* ours = dynamic_cast<const NeighborDCH*>(neighbor)) ours->count_work(work_.data());
  dch::lammps::reverse_communication(*comm, this, comm_reverse);
}

void FixDCHWork::grow_arrays(int nmax) {
  work_.resize(static_cast<std::size_t>(std::max(nmax, 1)), kOwn);
  if (reader_) reader_->vector_atom = work_.data();
}

void FixDCHWork::copy_arrays(int i, int j, int) { of(j) = of(i); }
void FixDCHWork::set_arrays(int i) { of(i) = kOwn; }

int FixDCHWork::pack_exchange(int i, double* buf) {
  buf[0] = of(i);
  return 1;
}

int FixDCHWork::unpack_exchange(int i, double* buf) {
  of(i) = buf[0];
  return 1;
}

int FixDCHWork::pack_reverse_comm(int n, int first, double* buf) {
  std::copy_n(work_.begin() + first, n, buf);
  return n;
}

void FixDCHWork::unpack_reverse_comm(int n, int* atoms, double* buf) {
  for (int k = 0; k < n; ++k) of(atoms[k]) += buf[k];
}

double FixDCHWork::memory_usage() { return static_cast<double>(work_.capacity() * sizeof(double)); }

}  // namespace LAMMPS_NS

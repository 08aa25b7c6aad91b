// SPDX-License-Identifier: GPL-2.0-or-later
// What of the fix travels with atoms, and what stands in restart files.
#include <algorithm>
#include <array>
#include <atom.h>
#include <comm.h>
#include <cstdio>
#include <cstring>
#include <error.h>

#include "fix_necklace_crossing.h"

namespace LAMMPS_NS {
namespace {

/// What write_restart() writes: its format, step, totals, box, periodicity.
constexpr int kFormat = 1;
constexpr int kGlobals = 2 + 5 + 9 + 3;

}  // namespace

void FixNecklaceCrossing::grow_arrays(int nmax) { pasts_.resize(nmax, atom->bond_per_atom); }
void FixNecklaceCrossing::copy_arrays(int i, int j, int) { pasts_.copy(i, j); }
void FixNecklaceCrossing::set_arrays(int i) { pasts_.forget(i); }
int FixNecklaceCrossing::pack_exchange(int i, double* buf) { return pasts_.write(i, buf); }
int FixNecklaceCrossing::unpack_exchange(int i, double* buf) { return pasts_.read(i, buf); }

// LAMMPS wants the count of all numbers first.
int FixNecklaceCrossing::pack_restart(int i, double* buf) {
  buf[0] = 1 + pasts_.write(i, buf + 1);
  return static_cast<int>(buf[0]);
}
int FixNecklaceCrossing::size_restart(int i) { return 1 + pasts_.numbers(i); }
int FixNecklaceCrossing::maxsize_restart() { return 1 + pasts_.most_numbers(); }
void FixNecklaceCrossing::unpack_restart(int i, int nth) {
  const double* at = atom->extra[i];
  for (int k = 0; k < nth; ++k) at += static_cast<int>(*at);
  pasts_.read(i, at + 1);
}

void FixNecklaceCrossing::write_restart(FILE* file) {
  if (comm->me != 0) return;
  std::array<double, kGlobals> all{};
  double* at = all.data();
  *at++ = kFormat;
  *at++ = static_cast<double>(old_step_);
  for (const double count :
       {total_.crossings, total_.contacts, total_.undetermined, total_.near, total_.rejected})
    *at++ = count;
  at = std::copy(old_box_.h.begin(), old_box_.h.end(), at);
  for (int k = 0; k < 3; ++k) *at++ = old_box_.low[k];
  for (const bool periodic : old_box_.periodic) *at++ = periodic ? 1.0 : 0.0;
  const int bytes = static_cast<int>(sizeof(all));
  std::fwrite(&bytes, sizeof(int), 1, file);
  std::fwrite(all.data(), sizeof(double), all.size(), file);
}

void FixNecklaceCrossing::restart(char* buffer) {
  std::array<double, kGlobals> all{};
  std::memcpy(all.data(), buffer, sizeof(all));
  if (all[0] != kFormat) error->all(FLERR, name_ + "the restart file is of another version; begin anew");
  old_step_ = static_cast<bigint>(all[1]);
  total_ = {all[2], all[3], all[4], all[5], all[6]};
  std::copy_n(all.begin() + 7, 6, old_box_.h.begin());
  old_box_.low = {all[13], all[14], all[15]};
  for (std::size_t k = 0; k < 3; ++k) old_box_.periodic[k] = all[16 + k] != 0;
}

int FixNecklaceCrossing::pack_forward_comm(int n, int* list, double* buf, int pbc_flag, int* pbc) {
  return atoms_.pack(n, list, buf, pbc_flag != 0, pbc);
}
void FixNecklaceCrossing::unpack_forward_comm(int n, int first, double* buf) { atoms_.unpack(n, first, buf); }

}  // namespace LAMMPS_NS

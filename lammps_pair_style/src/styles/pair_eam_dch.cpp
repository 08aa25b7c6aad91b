// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_eam_dch.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <fstream>
#include <sstream>
#include <update.h>
#include <utils.h>

#include "neighbor_dch.h"

namespace LAMMPS_NS {

PairEAMDCH::PairEAMDCH(LAMMPS* lammps, const char* plain, dch::lammps::EamFormat format)
    : PlainPair(lammps, plain), format_(format) {
  make_plain("MANYBODY");
  one_coeff = plain_->one_coeff;
  manybody_flag = plain_->manybody_flag;
  centroidstressflag = plain_->centroidstressflag;
  no_virial_fdotr_compute = plain_->no_virial_fdotr_compute;
  comm_forward = plain_->comm_forward;
  comm_reverse = plain_->comm_reverse;
}

// --------------------------------------------------------------------------------------------------------------------
// What a script says

void PairEAMDCH::settings(int narg, char** arg) {
  plain_->settings(narg, arg);
  of_types_.elements.assign(static_cast<std::size_t>(atom->ntypes), {});
  files_.clear();
}

/// Process 0 reads the file, as it does for the plain style.
std::string PairEAMDCH::text_of(const std::string& file) const {
  std::string text;
  int length = 0;
  if (comm->me == 0) {
    std::ifstream opened(utils::get_potential_file_path(file));
    std::ostringstream all;
    all << opened.rdbuf();
    text = all.str();
    length = static_cast<int>(text.size());
  }
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, world);
  return text;
}

/// Flags of types with themselves tell which of them a file of one element is for.
void PairEAMDCH::coeff(int narg, char** arg) {
  const int types = atom->ntypes;
  std::vector<int> flags(static_cast<std::size_t>(types + 1), 0);
  if (plain_->allocated)
    for (int a = 1; a <= types; ++a) std::swap(flags[static_cast<std::size_t>(a)], plain_->setflag[a][a]);
  plain_->coeff(narg, arg);
  const int number = static_cast<int>(files_.size());
  files_.push_back(dch::lammps::read_eam(text_of(arg[2]), format_));
  const std::vector<std::string>& names = files_.back().elements;
  for (int a = 1; a <= types; ++a) {
    dch::lammps::EamTypes::Element& element = of_types_.elements[static_cast<std::size_t>(a - 1)];
    if (format_ == dch::lammps::EamFormat::funcfl) {
      if (plain_->setflag[a][a]) element = {number, 0};
    } else {
      const auto found = std::find(names.begin(), names.end(), arg[2 + a]);
      element = {found == names.end() ? -1 : number, static_cast<int>(found - names.begin())};
    }
    if (flags[static_cast<std::size_t>(a)]) plain_->setflag[a][a] = 1;
  }
  take_flags_by_types();
}

double PairEAMDCH::init_one(int i, int j) {
  cutoff_ = PlainPair::init_one(i, j);
  atoms_.reset();
  return cutoff_;
}

double PairEAMDCH::memory_usage() {
  const std::size_t ours =
      (densities_.capacity() + slopes_.capacity()) * sizeof(double) + (atoms_ ? atoms_->memory_bytes() : 0);
  return PlainPair::memory_usage() + static_cast<double>(ours);
}

// --------------------------------------------------------------------------------------------------------------------
// A run begins

dch::lammps::Obstacle PairEAMDCH::reason_for_plain() const {
  for (const dch::lammps::EamTypes::Element& element : of_types_.elements) {
    if (element.file < 0) continue;
    const dch::lammps::EamFile& file = files_[static_cast<std::size_t>(element.file)];
    if (file.elements.empty()) return {"a file of the potential reads in another way than is known", {}};
    if (!file.units.empty() && file.units != update->unit_style)
      return {"the units of the potential are those of 'units " + file.units + "'", {}};
  }
  if (is_chosen_) return NeighborDCH::install(lmp)->obstacle_to_choice();
  return {};
}

void PairEAMDCH::init_style() {
  init_plain_with_lists();
  obstacle_ = reason_for_plain();
  computed_ = scaled_ = 0;
}

dch::lammps::StyleNote PairEAMDCH::explain() const {
  std::string how = "SIMD kernels of rows of pairs, in double precision, on one thread";
  if (scaled_ > 0)
    how += "; of " + std::to_string(computed_) + " times " + std::to_string(scaled_) +
           " by the plain style, as the potential was scaled";
  return note(how);
}

}  // namespace LAMMPS_NS

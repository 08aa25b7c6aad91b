// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_eam_dch.h"

#include <algorithm>
#include <atom.h>
#include <comm.h>
#include <error.h>
#include <force.h>
#include <fstream>
#include <memory.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <new>
#include <sstream>
#include <update.h>
#include <utils.h>

#include <dch/base/error.hpp>

#include "lammps_versions.h"
#include "neigh_history.h"
#include "neighbor_dch.h"
#include "plain_pair.h"
#include "stock_name.h"

namespace LAMMPS_NS {

PairEAMDCH::PairEAMDCH(LAMMPS* lammps, const char* plain, dch::lammps::EamFormat format)
    : Pair(lammps), plain_name_(plain), format_(format) {
  int has_suffix = 0;
  plain_.reset(force->new_pair(dch::lammps::stock_name(*force->pair_map, plain_name_), 0, has_suffix));
  if (!plain_) {
    error->all(FLERR, "Pair style " + plain_name_ + "/dch needs the pair style " + plain_name_ +
                          ", which this LAMMPS was built without (package MANYBODY)");
  }
  single_enable = plain_->single_enable;
  restartinfo = plain_->restartinfo;
  writedata = plain_->writedata;
  reinitflag = plain_->reinitflag;
  unit_convert_flag = plain_->unit_convert_flag;
  respa_enable = plain_->respa_enable;
  one_coeff = plain_->one_coeff;
  manybody_flag = plain_->manybody_flag;
  centroidstressflag = plain_->centroidstressflag;
  no_virial_fdotr_compute = plain_->no_virial_fdotr_compute;
  comm_forward = plain_->comm_forward;
  comm_reverse = plain_->comm_reverse;
}

PairEAMDCH::~PairEAMDCH() {
  if (!copymode) give_up_arrays_by_types(*this, *memory);
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
  take_flags_by_types(*plain_, types, *memory, *this);
}

void PairEAMDCH::modify_params(int narg, char** arg) {
  Pair::modify_params(narg, arg);
  plain_->modify_params(narg, arg);
}

double PairEAMDCH::init_one(int i, int j) {
  cutoff_ = plain_->init_one(i, j);
  plain_->cutsq[i][j] = plain_->cutsq[j][i] = cutoff_ * cutoff_;
  dch::lammps::copy_mixing<Pair>(*plain_, *this);
  atoms_.reset();
  return cutoff_;
}

void* PairEAMDCH::extract(const char* name, int& dimension) { return plain_->extract(name, dimension); }

void PairEAMDCH::add_tally_callback(Compute* compute) {
  Pair::add_tally_callback(compute);
  plain_->add_tally_callback(compute);
}

void PairEAMDCH::del_tally_callback(Compute* compute) {
  Pair::del_tally_callback(compute);
  plain_->del_tally_callback(compute);
}

double PairEAMDCH::memory_usage() {
  const std::size_t ours =
      (densities_.capacity() + slopes_.capacity()) * sizeof(double) + (atoms_ ? atoms_->memory_bytes() : 0);
  return Pair::memory_usage() + plain_->memory_usage() + static_cast<double>(ours);
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
  const int requests = neighbor->nrequest;
  plain_->init_style();
  const bool is_ours = turn_over_requests(*neighbor, requests, *plain_, *this);
  if (!is_ours && force->pair != this)
    error->all(FLERR, "Pair style " + plain_name_ +
                          "/dch does not know how this LAMMPS asks for lists in pair_style hybrid; give " +
                          plain_name_ + " there");
  obstacle_ = reason_for_plain();
  computed_ = scaled_ = 0;
}

void PairEAMDCH::init_list(int id, NeighList* neighbors) {
  Pair::init_list(id, neighbors);
  plain_->init_list(id, neighbors);
}

dch::lammps::StyleNote PairEAMDCH::explain() const {
  const std::string name = "pair " + plain_name_ + "/dch";
  if (!obstacle_.empty())
    return {name, "plain style, as " + obstacle_.reason +
                      (obstacle_.remedy.empty() ? std::string() : "; give " + obstacle_.remedy)};
  if (computed_ == 0) return {name, "no run yet"};
  std::string how = "SIMD kernels of rows of pairs, in double precision, on one thread";
  if (scaled_ > 0)
    how += "; of " + std::to_string(computed_) + " times " + std::to_string(scaled_) +
           " by the plain style, as the potential was scaled";
  return {name, how};
}

}  // namespace LAMMPS_NS

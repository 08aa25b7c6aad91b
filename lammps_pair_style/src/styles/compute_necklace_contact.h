// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(necklace/contact,ComputeNecklaceContact);
// clang-format on
#elif !defined(LMP_COMPUTE_NECKLACE_CONTACT_H)
#define LMP_COMPUTE_NECKLACE_CONTACT_H

#include <array>
#include <compute.h>
#include <lammps_host.h>
#include <memory>
#include <vector>

#include <dch/necklace/contact_finder.hpp>

#include "bond_check.h"
#include "chain_map.h"
#include "near_beads.h"

namespace LAMMPS_NS {

/// necklace/contact: where the chains of a group touch themselves and each other. The atoms' contacts, how
/// many there are, and a list of them: atom IDs and gap, each on the process that owns the atom of smaller
/// ID; and how they were found.
///
/// Every process finds the contacts of its own atoms, among these and the beads of others that may touch
/// them: along the chains while these are stretched, over space where they are packed, as it measures.
class ComputeNecklaceContact : public Compute {
 public:
  ComputeNecklaceContact(LAMMPS* lammps, int narg, char** arg);

  void init() override;
  double compute_scalar() override;
  void compute_peratom() override;
  void compute_local() override;
  void compute_array() override;
  double memory_usage() override;

 private:
  enum class Result { scalar, by_atom, local, search };

  void read_keywords(int narg, char** arg);
  int read_keyword(int narg, char** arg, int at);
  int read_radii(int narg, char** arg, int at);
  double positive(const char* word, const char* what);
  void find_for(Result asked);
  void find();
  bool find_among(bool everything, const dch::Box& box, bool is_new);
  dch::necklace::Necklace chains_here();
  void search(bool everything, const dch::Box& box, bool is_new);
  void keep(const std::vector<dch::necklace::Contact>& found);
  void add_up();

  dch::necklace::ContactQuery query_;
  std::vector<double> radius_of_type_;  ///< from 1 [length]; empty: the atoms' own
  ChainMap map_;
  NearBeads beads_;
  BondCheck bonds_;
  std::vector<std::int32_t> known_beads_;  ///< of the chains in finder_
  bool all_whole_ = true;                  ///< no bead of a chain of finder_ is missing
  std::unique_ptr<dch::necklace::ContactFinder> finder_;
  std::vector<dch::necklace::Contact> contacts_;  ///< of own beads; i and j are indices in beads_
  std::array<double, 2> measured_{};              ///< pairs of spheres and beads, when they were last counted
  bigint total_ = 0;                              ///< contacts, on all processes
  BeadTraffic traffic_;
  bigint found_at_ = -1;  ///< step of contacts_; -1 for none
  std::array<bool, 4>
      taken_{};  ///< by result: it has had contacts_ already, so its next call is of later positions
  std::vector<double> counts_;  ///< what vector_atom points to
  std::vector<std::array<double, 3> > rows_;
  std::vector<double*> row_starts_;  ///< what array_local points to
  std::array<double, 4> search_{};   ///< the row of the global array
  double* search_row_ = search_.data();
};

}  // namespace LAMMPS_NS

#endif

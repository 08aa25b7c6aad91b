// SPDX-License-Identifier: GPL-2.0-or-later
// What of LAMMPS has to be as it was in the versions that the adapter has been run with. Overridden
// functions, and members that are gone or closed, the compiler names by itself; here it names those that have
// become something else. What to do then: docs/lammps/install.md, "Other versions".
#include <atom.h>
#include <comm.h>
#include <neigh_list.h>
#include <pair.h>
#include <type_traits>

#include "neighbor_dch.h"

namespace LAMMPS_NS {

// `Inside` is what may read a member: the class itself, or one of ours that is derived from it.
#define DCH_RELIES_ON(Class, Inside, member, type)                             \
  static_assert(std::is_same_v<decltype(Inside::member), type>,                \
                "LAMMPS's " #Class "::" #member " is no longer of type " #type \
                ", as which the adapter takes it")

/// A member of NeighborDCH, so that it may read what Neighbor shows to classes derived from it.
struct NeighborDCH::ReliedOn {
  static_assert(std::is_copy_constructible_v<Neighbor>,
                "LAMMPS's Neighbor is no longer copyable, but NeighborDCH takes over its state by a copy");
  static_assert(std::has_virtual_destructor_v<Neighbor>,
                "LAMMPS's Neighbor no longer has a virtual destructor, by which LAMMPS deletes NeighborDCH");
  static_assert(
      std::has_virtual_destructor_v<Pointers>,
      "LAMMPS's Pointers no longer has a virtual destructor, by which requests for lists are withdrawn");

#define DCH_OF_NEIGHBOR(member, type) DCH_RELIES_ON(Neighbor, NeighborDCH, member, type)
  // The copy that keeps nothing, and what it is restricted to.
  DCH_OF_NEIGHBOR(copymode, int);
  DCH_OF_NEIGHBOR(plist, int*);
  DCH_OF_NEIGHBOR(npair_perpetual, int);
  DCH_OF_NEIGHBOR(nbin, int);
  DCH_OF_NEIGHBOR(nstencil, int);
  DCH_OF_NEIGHBOR(nstencil_perpetual, int);
  DCH_OF_NEIGHBOR(last_setup_bins, bigint);
  DCH_OF_NEIGHBOR(pairmasks, int*);
  // Lists, and who has asked for them.
  DCH_OF_NEIGHBOR(lists, NeighList**);
  DCH_OF_NEIGHBOR(nlist, int);
  DCH_OF_NEIGHBOR(requests, NeighRequest**);
  DCH_OF_NEIGHBOR(nrequest, int);
  DCH_OF_NEIGHBOR(oneatom, int);
  // Which pairs are listed.
  DCH_OF_NEIGHBOR(skin, double);
  DCH_OF_NEIGHBOR(cutneighmin, double);
  DCH_OF_NEIGHBOR(cutneighmax, double);
  DCH_OF_NEIGHBOR(cutneighmaxsq, double);
  DCH_OF_NEIGHBOR(cutneighsq, double**);
  DCH_OF_NEIGHBOR(cutneighghostsq, double**);
  DCH_OF_NEIGHBOR(collection, int*);
  DCH_OF_NEIGHBOR(cutcollectionsq, double**);
  DCH_OF_NEIGHBOR(cut_inner_sq, double);
  DCH_OF_NEIGHBOR(cut_middle_sq, double);
  DCH_OF_NEIGHBOR(cut_middle_inside_sq, double);
  DCH_OF_NEIGHBOR(includegroup, int);
  DCH_OF_NEIGHBOR(exclude, int);
  DCH_OF_NEIGHBOR(nex_type, int);
  DCH_OF_NEIGHBOR(ex_type, int**);
  DCH_OF_NEIGHBOR(nex_group, int);
  DCH_OF_NEIGHBOR(ex1_bit, int*);
  DCH_OF_NEIGHBOR(ex2_bit, int*);
  DCH_OF_NEIGHBOR(nex_mol, int);
  DCH_OF_NEIGHBOR(ex_mol_bit, int*);
  DCH_OF_NEIGHBOR(ex_mol_intra, int*);
  DCH_OF_NEIGHBOR(special_flag, int[4]);
  // When they are made.
  DCH_OF_NEIGHBOR(every, int);
  DCH_OF_NEIGHBOR(delay, int);
  DCH_OF_NEIGHBOR(dist_check, int);
  DCH_OF_NEIGHBOR(build_once, int);
  DCH_OF_NEIGHBOR(ago, int);
  DCH_OF_NEIGHBOR(ncalls, bigint);
  DCH_OF_NEIGHBOR(triggersq, double);
  DCH_OF_NEIGHBOR(xhold, double**);
  // Read as arrays of our own types, which no compiler would mind.
  DCH_OF_NEIGHBOR(bondlist, int**);
  DCH_OF_NEIGHBOR(anglelist, int**);
#undef DCH_OF_NEIGHBOR
};

DCH_RELIES_ON(Atom, Atom, x, double**);
DCH_RELIES_ON(Atom, Atom, f, double**);
DCH_RELIES_ON(Atom, Atom, tag, tagint*);
DCH_RELIES_ON(Atom, Atom, special, tagint**);
DCH_RELIES_ON(NeighList, NeighList, ilist, int*);
DCH_RELIES_ON(NeighList, NeighList, numneigh, int*);
DCH_RELIES_ON(NeighList, NeighList, firstneigh, int**);
DCH_RELIES_ON(NeighList, NeighList, respainner, int);
DCH_RELIES_ON(NeighList, NeighList, respamiddle, int);
DCH_RELIES_ON(NeighList, NeighList, firstneigh_inner, int**);
DCH_RELIES_ON(NeighList, NeighList, firstneigh_middle, int**);

}  // namespace LAMMPS_NS

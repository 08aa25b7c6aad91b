// SPDX-License-Identifier: GPL-2.0-or-later
#include "list_filler.h"

#include <algorithm>
#include <atom.h>
#include <domain.h>
#include <error.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <string>

#include "lammps_versions.h"
#include "level_rows.h"

namespace LAMMPS_NS {
// The neighbor that a point of row i stands for, -1 if it is none of this row.
int ListFiller::neighbor_of(const Scene& scene, int i, std::int32_t point, bool inside) const {
  const ServedList& served = scene.served;
  if (scene.points.in_box()) {
    const int j = inside ? point : scene.images.within_cutoff(i, point);
    // With newton off both rows of a pair have it here, and both keep it if it goes through a ghost.
    const bool is_twice = !served.full && !served.newton && j < atom->nlocal && j < i;
    return is_twice ? -1 : j;
  }
  const int j = scene.points.atom_of(point);
  if (served.ghost) {
    const double* cutsq =
        (i < atom->nlocal ? neighbor->cutneighsq : neighbor->cutneighghostsq)[atom->type[i]];
    const double *xi = atom->x[i], *xj = atom->x[j];
    if (norm2(dch::Vec3{xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]}) > cutsq[atom->type[j]]) return -1;
  }
  return served.newton && j >= atom->nlocal && !rules_.stored_here(i, j) ? -1 : j;
}

/// What an entry's special bits say beside the neighbor.
int ListFiller::mark_of(const ServedList& served, int i, int j) const {
  if (!served.history) return 0;
  const double *xi = atom->x[i], *xj = atom->x[j], reach = atom->radius[i] + atom->radius[j];
  return norm2(dch::Vec3{xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]}) < reach * reach
             ? dch::lammps::kTouching
             : 0;
}

/// Writes the row of atom i as LAMMPS wants it, maybe over itself. Returns how many neighbors are left.
int ListFiller::edit_row(const Scene& scene, int i, const std::int32_t* row, int count,
                         std::int32_t* to) const {
  // In the box the search has left out what the pair style never sees.
  const bool is_special =
      i < atom->nlocal && special_.has_partners(i) && (!scene.points.in_box() || special_.any_marked());
  const bool inside = scene.points.in_box() && scene.images.is_inside(i);
  int n = 0;
  for (int k = 0; k < count; ++k) {
    const int j = neighbor_of(scene, i, row[k], inside);
    if (j < 0 || (rules_.excludes_any() && rules_.excluded(i, j))) continue;
    int entry = j ^ mark_of(scene.served, i, j);
    if (is_special) {
      const int kind = special_.kind(i, j);
      const double *xi = atom->x[i], *xj = atom->x[j];
      // A bonded atom's far image is no bonded atom: LAMMPS stores it as an ordinary neighbor.
      if (kind != 0 && !domain->minimum_image_check(xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2])) {
        if (kind < 0) continue;
        entry ^= kind << SBBITS;
      }
    }
    to[n++] = entry;
  }
  return n;
}

/// Whether turns of processes and bonds are all that rows have to be edited for.
bool ListFiller::has_plain_rows(const Scene& scene) const {
  return !scene.points.in_box() && scene.served.newton && !scene.served.ghost && !scene.served.history &&
         !rules_.excludes_any() && rules_.goes_by_side() && !neighbor->includegroup &&
         special_.are_near_ones();
}

/// The same where rows are plain, without a branch for each neighbor.
int ListFiller::edit_plain_row(const Scene& scene, const SpecialPairs::Marks& marks, int i,
                               const std::int32_t* row, int count, std::int32_t* to) const {
  const tagint* const tag = atom->tag;
  const GhostSides& sides = rules_.sides();
  const bool any_marked = marks.any();
  int n = 0;
  for (int k = 0; k < count; ++k) {
    const int j = scene.points.atom_of(row[k]);
    const int mark = any_marked ? marks.of(i, tag[j]) : 0;
    to[n] = j ^ mark;
    n += sides.is_taken_here(j) & (mark != SpecialPairs::Marks::kInNoList) ? 1 : 0;
  }
  return n;
}

bool ListFiller::stays_as_it_is(const Scene& scene, int i, dch::Span<const std::int32_t> row) const {
  if (rules_.excludes_any() || scene.served.ghost || scene.served.history) return false;
  if (scene.points.in_box()) {
    const bool is_halved = !scene.served.full && !scene.served.newton;
    const bool is_marked = special_.any_marked() && special_.has_partners(i);
    return !is_halved && !is_marked && scene.images.is_inside(i);
  }
  if (neighbor->includegroup || special_.has_partners(i)) return false;
  return (!scene.served.newton && scene.points.are_atoms()) ||
         std::none_of(row.begin(), row.end(), [&](std::int32_t q) { return q >= scene.points.owned(); });
}

/// FixNeighHistory keeps what it knows of an atom in pages that hold no more.
void ListFiller::refuse_history(int i, int count) const {
  error->one(FLERR, "Atom " + std::to_string(atom->tag[i]) + " has " + std::to_string(count) +
                        " neighbors, but the history of contacts holds " + std::to_string(neighbor->oneatom) +
                        "; raise it with 'neigh_modify one'");
}

bool ListFiller::has_short_rows(const Scene& scene) {
  constexpr std::int64_t kLine = 16;
  const int owners = scene.served.ghost ? scene.points.size() : scene.points.owned();
  return owners > 0 && scene.served.rows.first.back() <= kLine * owners;
}

/// Makes room for short rows in the order of atoms, and notes where each is.
void ListFiller::sort_rows(ServedList& served) {
  const dch::NeighborList& rows = served.rows;
  row_of_.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) row_of_[static_cast<std::size_t>(rows.particle[r])] = r;
  served.by_atom.resize(static_cast<std::size_t>(rows.first.back()));
}

void ListFiller::fill(const AtomPoints& points, const GhostImages& images, ServedList& served,
                      NeighList& list) {
  const Scene scene{points, images, served};
  dch::NeighborList& rows = served.rows;
  const bool is_plain = has_plain_rows(scene), by_atom = has_short_rows(scene);
  constexpr std::size_t kAhead = 8;
  served.has_short_rows = by_atom;
  if (by_atom) sort_rows(served);
  std::int32_t* next = served.by_atom.data();
  const SpecialPairs::Marks* const marks = is_plain ? &special_.take_marks() : nullptr;
  served.pairs = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (by_atom && k + kAhead < rows.size())
      __builtin_prefetch(rows.j.data() + rows.first[row_of_[k + kAhead]]);
    const std::size_t r = by_atom ? row_of_[k] : k;
    const std::int32_t point = rows.particle[r];
    if (point >= points.owned() && !served.ghost) continue;
    const int i = points.atom_of(point);
    std::int32_t* const row = rows.j.data() + rows.first[r];
    std::int32_t* const to = by_atom ? next : row;
    auto count = static_cast<int>(rows.first[r + 1] - rows.first[r]);
    if (is_plain) {
      count = edit_plain_row(scene, *marks, i, row, count, to);
    } else if (!stays_as_it_is(scene, i, rows.row(r))) {
      count = edit_row(scene, i, row, count, to);
    } else if (by_atom) {
      std::copy_n(row, count, to);
    }
    if (served.history && count > neighbor->oneatom) refuse_history(i, count);
    list.firstneigh[i] = to;
    list.numneigh[i] = count;
    served.pairs += count;
    next += count;
  }
  list.inum = points.owned();
  list.gnum = served.ghost ? points.size() - points.owned() : 0;
  // LAMMPS keeps its atoms sorted: pair styles are fastest in that order, wherever the rows are.
  for (int point = 0; point < list.inum + list.gnum; ++point) list.ilist[point] = points.atom_of(point);
  fill_levels(*atom, *neighbor, served, list);
  served.pairs += static_cast<std::int64_t>(served.inner.size() + served.middle.size());
}

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: GPL-2.0-or-later
#include "candidate_rows.h"

#include <algorithm>

namespace dch::lammps {

void CandidateRows::prepare(const HierarchyParams& params) {
  if (search_ && params.radius == params_.radius && params.c == params_.c) return;
  search_.reset();
  search_ = factory_(params);
  params_ = params;
}

void CandidateRows::update(Span<const Vec3> positions, Span<const std::uint64_t> keys) {
  for (Entry& e : entries_) e.valid = false;
  search_->update(positions, Box::none(), keys);
}

const NeighborList& CandidateRows::rows(const ListParams& params) {
  const bool full = params.kind == ListKind::full;
  const bool ghosts = params.first_ghost < 0;
  auto entry = std::find_if(entries_.begin(), entries_.end(),
                            [&](const Entry& e) { return e.full == full && e.ghosts == ghosts; });
  if (entry == entries_.end()) {
    entries_.push_back({full, ghosts, false, {}});
    entry = entries_.end() - 1;
  }
  if (!entry->valid) {
    search_->list(params, entry->rows);
    entry->valid = true;
  }
  return entry->rows;
}

}  // namespace dch::lammps

// SPDX-License-Identifier: GPL-2.0-or-later
#include "neigh_history.h"

#include <cstddef>
#include <cstring>
#include <fix.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>

#include "known_fixes.h"

namespace LAMMPS_NS {
namespace {

/// Where members of a class derived from Base begin.
template <class Base>
std::size_t end_of() {
  struct Derived : Base {
    int first;
  };
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
  return offsetof(Derived, first);
#pragma GCC diagnostic pop
}

}  // namespace

template <class T>
T NeighHistory::read(std::size_t pointer) const {
  T value;
  std::memcpy(&value, members_ + pointer * sizeof(void*), sizeof value);
  return value;
}

/// The pointers stand behind two numbers, from 2022 on behind three.
bool NeighHistory::find(const Modify& modify, const Pair& style) {
  for (int k = 0; k < modify.nfix; ++k) {
    const Fix& fix = *modify.fix[k];
    if (std::strcmp(fix.style, kHistoryFix) != 0) continue;
    for (const std::size_t numbers : {std::size_t{2}, std::size_t{3}}) {
      const std::size_t behind = end_of<Fix>() + numbers * sizeof(int);
      const std::size_t at = (behind + sizeof(void*) - 1) / sizeof(void*) * sizeof(void*);
      members_ = reinterpret_cast<const char*>(&fix) + at;
      if (read<const Pair*>(2) == &style) return true;
    }
  }
  members_ = nullptr;
  return false;
}

bool turn_over_requests(Neighbor& neighbor, int first, const Pair& from, Pair& to) {
  for (int k = first; k < neighbor.nrequest; ++k) {
    char* const words = reinterpret_cast<char*>(neighbor.requests[k]) + sizeof(Pointers);
    bool turned = false;
    for (int word = 0; word < 2 && !turned; ++word) {
      char* const at = words + word * static_cast<std::ptrdiff_t>(sizeof(void*));
      const void *asker, *next = &to;
      std::memcpy(&asker, at, sizeof asker);
      turned = asker == &from;
      if (turned) std::memcpy(at, &next, sizeof next);
    }
    if (!turned) return false;
  }
  return neighbor.nrequest > first;
}

void ContactColumns::take(const NeighList& list, const NeighHistory* history, const double* weights) {
  std::vector<Cut> cuts;
  i_.clear();
  j_.clear();
  const std::int32_t* next_mark = nullptr;  // of history that goes on where the last pair's ends
  for (int row = 0; row < list.inum; ++row) {
    const int i = list.ilist[row];
    for (int k = 0; k < list.numneigh[i]; ++k) {
      const int neighbor = list.firstneigh[i][k];
      if (weights[static_cast<unsigned>(neighbor) >> SBBITS & 3] == 0) continue;
      std::int32_t* const mark = history ? history->marks()[i] + k : nullptr;
      double* const value = history ? history->values()[i] + 3 * k : nullptr;
      const bool goes_on = !cuts.empty() && mark == next_mark &&
                           (!history || value == cuts.back().value + 3 * (i_.size() - cuts.back().pair));
      if (!goes_on) cuts.push_back({i_.size(), mark, value});
      next_mark = history ? mark + 1 : nullptr;
      i_.push_back(i);
      j_.push_back(neighbor & NEIGHMASK);
    }
  }
  pieces_.clear();
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const Cut& cut = cuts[c];
    const std::size_t count = (c + 1 < cuts.size() ? cuts[c + 1].pair : i_.size()) - cut.pair;
    const std::size_t kept = history ? count : 0;
    pieces_.push_back({{i_.data() + cut.pair, count},
                       {j_.data() + cut.pair, count},
                       {cut.mark, kept},
                       {reinterpret_cast<dch::Vec3*>(cut.value), kept}});
  }
}

}  // namespace LAMMPS_NS

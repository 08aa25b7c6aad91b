// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// What LAMMPS's versions from 29 Sep 2021 to 4 Jul 2026 have beyond the oldest of them. The headers at hand
// tell, not a version number. A class that has only been declared has no members: asking about it does not
// compile, by its size.
#include <lmptype.h>
#include <type_traits>
#include <utility>

namespace dch::lammps {

/// FixNeighHistory's mark of a pair that touches; it has a bit of its own in later versions.
#ifdef HISTBITS
inline constexpr int kTouching = 1 << HISTBITS;
#else
inline constexpr int kTouching = static_cast<int>(3u << SBBITS);
#endif

template <class Style, class = void>
inline constexpr bool kHasTrim = sizeof(Style) == 0;
template <class Style>
inline constexpr bool kHasTrim<Style, std::void_t<decltype(Style::trim_flag)>> = true;

template <class Style, class = void>
inline constexpr bool kNotesMixing = sizeof(Style) == 0;
template <class Style>
inline constexpr bool kNotesMixing<Style, std::void_t<decltype(Style::did_mix)>> = true;

/// Whether pair_style hybrid asks for a list with the largest cutoff of this sub-style for all types, which
/// the installed headers do not tell of a list (`pair_modify neigh/trim`).
template <class Style>
bool wants_own_cutoff([[maybe_unused]] const Style& sub_style) {
  if constexpr (kHasTrim<Style>) return sub_style.trim_flag != 0;
  return false;
}

template <class Comm, class Style, class = void>
inline constexpr bool kNamesCommByStyle = sizeof(Comm) == 0;
template <class Comm, class Style>
inline constexpr bool kNamesCommByStyle<
    Comm, Style, std::void_t<decltype(std::declval<Comm&>().forward_comm_fix(std::declval<Style*>(), 0))>> =
    true;

/// Sends numbers of a fix from owned atoms to their ghosts, so many for each atom.
template <class Comm, class Style>
void forward_communication(Comm& comm, Style* fix, int numbers) {
  if constexpr (kNamesCommByStyle<Comm, Style>) {
    comm.forward_comm_fix(fix, numbers);
  } else {
    comm.forward_comm(fix, numbers);
  }
}

template <class Comm, class Style, class = void>
inline constexpr bool kNamesCommByPair = sizeof(Comm) == 0;
template <class Comm, class Style>
inline constexpr bool kNamesCommByPair<
    Comm, Style, std::void_t<decltype(std::declval<Comm&>().forward_comm_pair(std::declval<Style*>()))>> =
    true;

/// The same of a pair style.
template <class Comm, class Style>
void forward_communication_of_pair(Comm& comm, Style* pair) {
  if constexpr (kNamesCommByPair<Comm, Style>) {
    comm.forward_comm_pair(pair);
  } else {
    comm.forward_comm(pair);
  }
}

/// Adds numbers of ghosts to those of owned atoms.
template <class Comm, class Style>
void reverse_communication(Comm& comm, Style* pair) {
  if constexpr (kNamesCommByPair<Comm, Style>) {
    comm.reverse_comm_pair(pair);
  } else {
    comm.reverse_comm(pair);
  }
}

/// The same of a fix, so many for each atom.
template <class Comm, class Style>
void reverse_communication_of_fix(Comm& comm, Style* fix, int numbers) {
  if constexpr (kNamesCommByStyle<Comm, Style>) {
    comm.reverse_comm_fix(fix, numbers);
  } else {
    comm.reverse_comm(fix, numbers);
  }
}

/// Copies whether the last coefficients come from mixing, which the log counts.
template <class Style>
void copy_mixing([[maybe_unused]] const Style& from, [[maybe_unused]] Style& to) {
  if constexpr (kNotesMixing<Style>) to.did_mix = from.did_mix;
}

}  // namespace dch::lammps

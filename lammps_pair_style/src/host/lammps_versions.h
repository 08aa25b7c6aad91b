// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

// What LAMMPS's versions from 29 Sep 2021 to 4 Jul 2026 have beyond the oldest of them. The headers at hand
// tell, not a version number. A class that has only been declared has no members: asking about it does not
// compile, by its size.
#include <lmptype.h>
#include <type_traits>

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

/// Whether functions of Comm have the kind of style in their names.
template <class Comm, class = void>
inline constexpr bool kNamesStyles = sizeof(Comm) == 0;
template <class Comm>
inline constexpr bool kNamesStyles<Comm, std::void_t<decltype(&Comm::forward_comm_fix)>> = true;

/// Sends numbers of a pair style from owned atoms to their ghosts, or of a fix so many for each atom.
template <class Comm, class Style, class... Count>
void forward_communication(Comm& comm, Style* style, Count... numbers) {
  if constexpr (!kNamesStyles<Comm>)
    comm.forward_comm(style, numbers...);
  else if constexpr (sizeof...(numbers) == 0)
    comm.forward_comm_pair(style);
  else
    comm.forward_comm_fix(style, numbers...);
}

/// Adds such numbers of ghosts to those of owned atoms.
template <class Comm, class Style, class... Count>
void reverse_communication(Comm& comm, Style* style, Count... numbers) {
  if constexpr (!kNamesStyles<Comm>)
    comm.reverse_comm(style, numbers...);
  else if constexpr (sizeof...(numbers) == 0)
    comm.reverse_comm_pair(style);
  else
    comm.reverse_comm_fix(style, numbers...);
}

/// Copies whether the last coefficients come from mixing, which the log counts.
template <class Style>
void copy_mixing([[maybe_unused]] const Style& from, [[maybe_unused]] Style& to) {
  if constexpr (kNotesMixing<Style>) to.did_mix = from.did_mix;
}

}  // namespace dch::lammps

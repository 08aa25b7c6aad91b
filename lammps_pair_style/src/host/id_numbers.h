// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <error.h>
#include <lammps_host.h>
#include <limits>
#include <string>

namespace LAMMPS_NS {

/// An ID or image flags in a buffer of doubles: the number itself where every one is exact, else its bits.
template <class Integer>
double in_double(Integer number) {
  static_assert(sizeof(Integer) <= sizeof(double), "the bits have to fit");
  if constexpr (std::numeric_limits<Integer>::digits <= std::numeric_limits<double>::digits) {
    return static_cast<double>(number);
  } else {
    double bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
  }
}

template <class Integer>
Integer from_double(double written) {
  if constexpr (std::numeric_limits<Integer>::digits <= std::numeric_limits<double>::digits) {
    return static_cast<Integer>(written);
  } else {
    Integer number = 0;
    std::memcpy(&number, &written, sizeof number);
    return number;
  }
}

/// The ID that random numbers are drawn by, whose generator takes 32 bits.
inline std::int32_t drawn_by(tagint id, Error& error) {
  if constexpr (sizeof(tagint) > sizeof(std::int32_t)) {
    if (id > std::numeric_limits<std::int32_t>::max())
      error.one(FLERR, "Atom ID " + std::to_string(id) +
                           " is beyond 2147483647, up to which the styles philox draw random numbers by ID; "
                           "number the atoms anew with 'reset_atom_ids', in newer versions 'reset_atoms id'");
  }
  return static_cast<std::int32_t>(id);
}

}  // namespace LAMMPS_NS

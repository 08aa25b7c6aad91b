// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#if defined(__GNUC__)
#define DCH_EXPORT __attribute__((visibility("default")))
#else
#define DCH_EXPORT
#endif

/// Gives the LAMMPS instance behind this handle the command `dch` and the styles with the suffix dch. Lists
/// stay native until a script says `dch on`. Returns 0, also if it has the command already. Otherwise the
/// instance is left as it was, a message on stderr says what is wrong, and the result is 1: libraries for
/// another LAMMPS version, whose classes are laid out differently although its file has the same name.
extern "C" DCH_EXPORT int dch_register(void* lammps);

/// The same for LAMMPS's command `plugin load`, which passes its handle of the library and the function that
/// enters commands and styles. Enters nothing if the version does not fit.
extern "C" DCH_EXPORT void lammpsplugin_init(void* lammps, void* handle, void* register_function);

namespace dch::lammps {

/// Whether the library was built for the version of the LAMMPS with this handle; if not, a message on stderr
/// says so.
bool fits_version(void* handle);

/// Whether atom IDs of so many bytes are those that the library was built for; if not, a message on stderr
/// says so.
bool fits_ids_of(int bytes);

}  // namespace dch::lammps

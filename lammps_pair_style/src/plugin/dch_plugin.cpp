// SPDX-License-Identifier: GPL-2.0-or-later
//
// What LAMMPS's command `plugin load` looks for in a library (LAMMPS manual, "Writing plugins"). The
// declarations stand here because LAMMPS's packages do not install lammpsplugin.h.
#include <lammps_host.h>

#include "dch_command.h"
#include "dch_register.h"
#include "styles.h"

namespace {

extern "C" {
using Factory = void*(void* lammps);
using FactoryWithArguments = void*(void* lammps, int count, char** arguments);

/// One command or style.
struct PluginEntry {
  const char* version;  ///< of LAMMPS, that the plugin was built for
  const char* style;    ///< kind: "command", "pair", ...
  const char* name;
  const char* info;
  const char* author;
  union {
    Factory* v1;
    FactoryWithArguments* v2;
  } creator;
  void* handle;  ///< of the library
};
using RegisterFunction = void(PluginEntry* entry, void* lammps);

// LAMMPS takes the pointers for those to its base classes.
void* create_command(void* lammps) {
  LAMMPS_NS::Command* const made = new LAMMPS_NS::DchCommand(static_cast<LAMMPS_NS::LAMMPS*>(lammps));
  return made;
}
}

// LAMMPS casts them back, by the kind of the style.
template <class Base>
void set_creator(PluginEntry& entry, Base* (*create)(LAMMPS_NS::LAMMPS*)) {
  entry.creator.v1 = reinterpret_cast<Factory*>(create);
}
template <class Base>
void set_creator(PluginEntry& entry, Base* (*create)(LAMMPS_NS::LAMMPS*, int, char**)) {
  entry.creator.v2 = reinterpret_cast<FactoryWithArguments*>(create);
}

}  // namespace

void lammpsplugin_init(void* lammps, void* handle, void* register_function) {
  if (!dch::lammps::fits_version(lammps)) return;
  auto* const enter = reinterpret_cast<RegisterFunction*>(register_function);
  PluginEntry entry{};
  entry.version = static_cast<LAMMPS_NS::LAMMPS*>(lammps)->version;
  entry.author = "the authors of DCH";
  entry.handle = handle;
  entry.info = "neighbor lists from a discrete center hierarchy";
  entry.style = "command";
  entry.name = "dch";
  entry.creator.v1 = &create_command;
  enter(&entry, lammps);
  const auto enter_all = [&](const char* kind, const auto& styles) {
    entry.style = kind;
    for (const auto& style : styles) {
      entry.name = style.name;
      set_creator(entry, style.create);
      enter(&entry, lammps);
    }
  };
  enter_all("pair", LAMMPS_NS::pair_styles_dch());
  enter_all("bond", LAMMPS_NS::bond_styles_dch());
  enter_all("angle", LAMMPS_NS::angle_styles_dch());
  enter_all("compute", LAMMPS_NS::compute_styles_dch());
  enter_all("fix", LAMMPS_NS::fix_styles_dch());
}

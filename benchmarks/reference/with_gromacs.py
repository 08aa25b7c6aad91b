# SPDX-License-Identifier: MIT
"""GROMACS: `mdrun -rerun` in single precision (gmx) and in double (gmx_d)."""

import os
import shutil
import struct
import tempfile

import numpy as np

import all_pairs
import program

UNITS = "nm and kJ/mol, as given"
TRR_MAGIC = 1993
# What mdrun says where a processor lacks an instruction that Debian's build has, as some virtual ones lack rdtscp.
NOT_THIS_PROCESSOR = "not supported by the current hardware"
SINGLE = program.Precision(program.SINGLE.rms, program.SINGLE.largest, 1e-4, program.SINGLE.why + "; the energy is summed up in "
                           "single precision too: 3.5e-6, 3.6e-5 and 7.4e-5 off for 216, 1,728 and 5,832 molecules of water")
MDP = """
cutoff-scheme = Verlet
verlet-buffer-tolerance = -1
rlist = {cutoff:.17g}
rcoulomb = {cutoff:.17g}
rvdw = {cutoff:.17g}
vdw-modifier = None
coulombtype = reaction-field
epsilon-rf = {dielectric}
nsteps = 0
nstfout = 1
nstenergy = 1
nstcalcenergy = 1
comm-mode = None
continuation = yes
DispCorr = no
"""


def topology(scene):
    kinds, size = scene.kinds, scene.atoms_per_molecule
    lines = ["[ defaults ]", "1 2 no 1 1", "[ atomtypes ]"]  # comb-rule 2: Lorentz and Berthelot
    lines += [f"{k.name} 1 {k.mass} {k.charge} A {k.sigma:.17g} {k.epsilon:.17g}" for k in kinds]
    lines += ["[ moleculetype ]", "MOL 0", "[ atoms ]"]
    lines += [f"{a + 1} {kinds[scene.kind[a]].name} 1 MOL {kinds[scene.kind[a]].name}{a} 1 {kinds[scene.kind[a]].charge} "
              f"{kinds[scene.kind[a]].mass}" for a in range(size)]
    if size == 3:
        everyone = range(1, size + 1)  # a rigid molecule; the lengths matter to nobody who computes forces alone
        lines += ["[ settles ]", "1 1 0.1 0.16330", "[ exclusions ]"] + [" ".join(map(str, [a, *(b for b in everyone if b != a)])) for a in everyone]
    return "\n".join(lines + ["[ system ]", "scene", "[ molecules ]", f"MOL {len(scene.positions) // size}"]) + "\n"


def gro(scene):
    """Sixteen decimals, of which GROMACS takes the number from the distance between decimal points."""
    lines = ["scene", str(len(scene.positions))]
    size = scene.atoms_per_molecule
    for k, at in enumerate(scene.positions):
        name = scene.kinds[scene.kind[k]].name + str(k % size)
        lines.append(f"{(k // size + 1) % 100000:5}MOL  {name:>5}{(k + 1) % 100000:5}" + "".join(f"{x:21.16f}" for x in at))
    v = scene.vectors
    box = [v[0][0], v[1][1], v[2][2], 0, 0, v[1][0], 0, v[2][0], v[2][1]]
    return "\n".join(lines + [" ".join(f"{x:.16f}" for x in box)]) + "\n"


def forces_of_trr(path, atoms):
    """The forces of the first frame: the last block of numbers, after 13 integers that tell the sizes of all blocks."""
    with open(path, "rb") as file:
        data = file.read()
    magic, _, length = struct.unpack(">3i", data[:12])
    if magic != TRR_MAGIC:
        raise program.Failed("GROMACS has written no TRR file")
    header = 12 + (length + 3) // 4 * 4
    *sizes, count, _, _ = struct.unpack(">13i", data[header:header + 52])
    box, blocks, forces = sizes[2], sum(sizes), sizes[9]
    real = box // 9
    if count != atoms or forces != 3 * real * atoms:
        raise program.Failed(f"GROMACS has written forces of {count} atoms in {forces} bytes, not of {atoms}")
    begin = header + 52 + 2 * real + blocks - forces  # time and lambda stand between
    return np.frombuffer(data[begin:begin + forces], ">f4" if real == 4 else ">f8").reshape(-1, 3).astype(float)


def compute(scene, gmx):
    if shutil.which(gmx) is None:
        raise program.Missing(f"{gmx} is missing; install the Debian package gromacs")
    mdp = MDP.format(cutoff=scene.cutoff, dielectric=scene.dielectric or 1)
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("scene.gro", gro(scene)), ("scene.top", topology(scene)), ("scene.mdp", mdp)):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        program.run([gmx, "-quiet", "grompp", "-f", "scene.mdp", "-c", "scene.gro", "-p", "scene.top", "-o", "scene.tpr",
                     "-maxwarn", 2], folder)
        program.run([gmx, "-quiet", "mdrun", "-ntmpi", 1, "-ntomp", 1, "-pin", "off", "-nb", "cpu", "-s", "scene.tpr",
                     "-rerun", "scene.gro", "-o", "scene.trr", "-e", "scene.edr", "-g", "scene.log"], folder,
                    refusal=NOT_THIS_PROCESSOR)
        program.run([gmx, "-quiet", "energy", "-f", "scene.edr", "-o", "energy.xvg", "-dp", "-xvg", "none"], folder,
                    "Potential\n\n")
        energy = float(np.loadtxt(os.path.join(folder, "energy.xvg"))[1])
        return all_pairs.Answer(forces_of_trr(os.path.join(folder, "scene.trr"), len(scene.positions)), energy)


def programs():
    return [program.Program(f"GROMACS, {gmx} mdrun -rerun", lambda scene, gmx=gmx: compute(scene, gmx), UNITS,
                            all_pairs.CODATA_2018, precision, field_between_bonded=True)
            for gmx, precision in (("gmx", SINGLE), ("gmx_d", program.DOUBLE))]

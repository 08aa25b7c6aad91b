# SPDX-License-Identifier: MIT
"""LAMMPS: plain pair styles with its own lists, with ours, and our pair styles by the suffix.

LAMMPS has no style for a reaction field. That of 1/r comes from lj/cut/coul/cut, the rest from a table: the energy
krf r^2 - crf and its force over r are linear in r^2, which is how LAMMPS interpolates, so that nothing is lost.
"""

import os
import shutil
import tempfile

import numpy as np

import all_pairs
import program

KCAL, ANGSTROM = 4.184, 0.1               # kJ, nm
QQR2E = 332.06371 * KCAL * ANGSTROM       # Force::qqr2e of `units real` in kcal A/mol/e^2, here in kJ nm/mol/e^2
TABLE_ROWS, TABLE_FROM = 1000, 0.5        # [A], nearer than any pair that is not excluded
UNITS = "A and kcal/mol (units real): 1 A = 0.1 nm, 1 kcal = 4.184 kJ"
DCH = "; with include dch.lmp"


def data_file(scene):
    """Atoms with molecules, and the bonds and angles that exclude pairs within these."""
    count, size = len(scene.positions), scene.atoms_per_molecule
    v, molecules = scene.vectors / ANGSTROM, count // size
    lines = ["", "", f"{count} atoms", f"{len(scene.kinds)} atom types"]
    if size == 3:
        lines += [f"{2 * molecules} bonds", "1 bond types", f"{molecules} angles", "1 angle types"]
    lines += [f"0 {v[k][k]:.17g} {axis}lo {axis}hi" for k, axis in enumerate("xyz")]
    if scene.vectors[1][0] or scene.vectors[2][0] or scene.vectors[2][1]:
        lines.append(f"{v[1][0]:.17g} {v[2][0]:.17g} {v[2][1]:.17g} xy xz yz")
    lines += ["", "Masses", ""] + [f"{k + 1} {kind.mass}" for k, kind in enumerate(scene.kinds)] + ["", "Atoms # full", ""]
    charge = scene.of_atoms("charge")
    for k, at in enumerate(scene.positions / ANGSTROM):
        lines.append(f"{k + 1} {k // size + 1} {scene.kind[k] + 1} {charge[k]} " + " ".join(f"{x:.17g}" for x in at))
    if size == 3:
        first = 3 * np.arange(molecules) + 1
        lines += ["", "Bonds", ""] + [f"{2 * m + arm} 1 {o} {o + arm}" for m, o in enumerate(first) for arm in (1, 2)]
        lines += ["", "Angles", ""] + [f"{m + 1} 1 {o + 1} {o} {o + 2}" for m, o in enumerate(first)]
    return "\n".join(lines) + "\n"


def tables(scene):
    """krf r^2 - crf between each two kinds."""
    krf, crf = scene.field()
    krf, crf, cutoff = krf * ANGSTROM**3, crf * ANGSTROM, scene.cutoff / ANGSTROM
    constant = QQR2E / KCAL / ANGSTROM
    text = []
    for a, first in enumerate(scene.kinds):
        for second in scene.kinds[a:]:
            qq = constant * first.charge * second.charge
            text.append(f"\n{first.name}_{second.name}\nN {TABLE_ROWS} RSQ {TABLE_FROM} {cutoff:.17g}\n")
            for k, r2 in enumerate(np.linspace(TABLE_FROM**2, cutoff**2, TABLE_ROWS)):
                r = np.sqrt(r2)
                text.append(f"{k + 1} {r:.17g} {qq * (krf * r2 - crf):.17g} {-2 * qq * krf * r:.17g}")
    return "\n".join(text) + "\n"


def pair_lines(scene):
    cutoff, kinds = f"{scene.cutoff / ANGSTROM:.17g}", scene.kinds
    plain = "lj/cut/coul/cut" if scene.charged else "lj/cut"
    style = f"pair_style hybrid/overlay {plain} {cutoff} table linear {TABLE_ROWS}" if scene.charged else \
        f"pair_style {plain} {cutoff}"
    lines = ["bond_style zero", "angle_style zero", "special_bonds lj/coul 0 0 0", style] if scene.charged else [style]
    name = f"{plain} " if scene.charged else ""
    for a, first in enumerate(kinds):
        for b, second in enumerate(kinds[a:], a):
            epsilon, sigma = np.sqrt(first.epsilon * second.epsilon), (first.sigma + second.sigma) / 2
            lines.append(f"pair_coeff {a + 1} {b + 1} {name}{epsilon / KCAL:.17g} {sigma / ANGSTROM:.17g}")
            if scene.charged:
                lines.append(f"pair_coeff {a + 1} {b + 1} table field.table {first.name}_{second.name} {cutoff}")
    return lines + (["bond_coeff *", "angle_coeff *"] if scene.charged else [])


def script(scene, before):
    return "\n".join([*before, "units real", "atom_style full", "box tilt large", "read_data scene.data",
                      *pair_lines(scene), "neighbor 0.2 bin",
                      "dump forces all custom 1 forces.txt id fx fy fz",
                      "dump_modify forces sort id format float %.17g",
                      "thermo_style custom step pe", "thermo_modify format float %.17g", "fix energy all print 1 "
                      "\"$(pe:%.17g)\" file energy.txt screen no title \"\"", "run 0"]) + "\n"


def compute(scene, before):
    if shutil.which("lmp") is None:
        raise program.Missing("lmp is missing; install the Debian package lammps")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("scene.data", data_file(scene)), ("in.scene", script(scene, before)),
                           ("field.table", tables(scene) if scene.charged else "")):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        program.run(["lmp", "-log", "none", "-in", "in.scene"], folder)
        forces = np.loadtxt(os.path.join(folder, "forces.txt"), skiprows=9)[:, 1:]
        energy = float(np.loadtxt(os.path.join(folder, "energy.txt")))
    return all_pairs.Answer(forces * KCAL / ANGSTROM, energy * KCAL)




def programs(build):
    """Those of stock LAMMPS; and ours, if the build has the adapter."""
    adapter = os.path.join(build, "lammps_pair_style", "dch.lmp")
    library = os.path.join(build, "lammps_pair_style", "libdch_lammps.so")  # which the former names

    def with_dch(*lines):
        def run_it(scene):
            if not os.path.exists(adapter) or not os.path.exists(library):
                raise program.Missing("lammps_pair_style/libdch_lammps.so is not in the build (DCH_BUILD_LAMMPS)")
            return compute(scene, [f"include {adapter}", *lines])
        return run_it

    return [program.Program("LAMMPS, plain styles", lambda scene: compute(scene, []), UNITS, QQR2E, program.DOUBLE),
            program.Program("LAMMPS, dch on", with_dch("dch styles no", "dch on"), UNITS + DCH, QQR2E, program.DOUBLE),
            program.Program("LAMMPS, suffix dch", with_dch("suffix dch"), UNITS + DCH, QQR2E, program.DOUBLE),
            program.Program("LAMMPS, suffix dch, mixed", with_dch("suffix dch", "dch precision mixed"), UNITS + DCH,
                            QQR2E, program.MIXED)]

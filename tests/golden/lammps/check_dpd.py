#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""pair_style dpd/philox and dpd/tstat/philox in a real LAMMPS, beside all pairs in plain Python."""

import itertools
import math
import unittest

from langevin_oracle import philox
from script_tests import host, main, run

from lammps_run import thermo_tables

SEED, SIDE = 904297, 5.0
# By pair of types: repulsion, friction, cutoff.
PAIRS = {(1, 1): (25.0, 4.5, 1.0), (1, 2): (31.0, 2.0, 0.8), (2, 2): (18.0, 6.5, 1.2)}
COEFFICIENTS = "".join(f"pair_coeff {a} {b} {r} {f} {c}\n" for (a, b), (r, f, c) in PAIRS.items())
FLUID = f"""
units lj
newton ${{newton}}
atom_style bond
region box block 0 {SIDE} 0 {SIDE} 0 {SIDE}
create_box 2 box bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 1
create_atoms 1 random 375 4711 box
set type 1 type/fraction 2 0.3 881
mass * 1.0
comm_modify vel yes
velocity all create 1.0 87287 loop all
neighbor 0.3 bin
neigh_modify delay 0 every 1 check yes
timestep 0.01
thermo_modify format float %.15g
"""
BOND = "bond_style zero\nbond_coeff *\n"
DPD = f"pair_style dpd/philox 1.0 1.0 {SEED}\n{COEFFICIENTS}fix 1 all nve\n"
IMAGES = list(itertools.product((-SIDE, 0.0, SIDE), repeat=3))


def atoms_after(script, ranks=1, newton="on", lists="", numbers="x y z vx vy vz fx fy fz"):
    """Numbers of atoms by ID after the last step, with every bit, and the output."""
    dump = host.work / "dump.dpd"
    output = run(f"include ${{load}}\n{lists}{script}write_dump all custom {dump} id type {numbers} "
                 "modify sort id format float %.17g\n", ranks=ranks, variables={"newton": newton})
    rows = [line.split() for line in dump.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]]
    return {int(row[0]): (int(row[1]), *map(float, row[2:])) for row in rows}, output


def fluid_from_file():
    """The fluid, with IDs that do not depend on the number of processes that read it."""
    file = host.work / "fluid.restart"
    run(f"{FLUID}pair_style none\n{BOND}write_restart {file}\n", variables={"newton": "on"})
    return f"newton ${{newton}}\nread_restart {file}\n{BOND}comm_modify vel yes\ntimestep 0.01\n" \
        "neighbor 0.3 bin\nneigh_modify delay 0 every 1 check yes\nthermo_modify format float %.15g\n"


class AllPairs:
    """Forces, energy and virial of the atoms of a dump, with all images."""

    def __init__(self, atoms, step, temperature, weights=None, dt=0.01, repels=True, pairs=None):
        self.forces = {atom: [0.0] * 3 for atom in atoms}
        self.energy, self.virial, self.count = 0.0, 0.0, 0
        for a, b in itertools.combinations(sorted(atoms), 2):
            kind = tuple(sorted((atoms[a][0], atoms[b][0])))
            repulsion, friction, cutoff = (pairs or PAIRS)[kind]
            weight = (weights or {}).get((a, b), 1.0)
            apart = [p - q for p, q in zip(atoms[a][1:4], atoms[b][1:4])]
            apart = [d - SIDE * round(d / SIDE) for d in apart]
            r = math.sqrt(sum(d * d for d in apart))
            if r >= cutoff:
                continue
            w = 1 - r / cutoff
            approach = sum(d * (p - q) for d, p, q in zip(apart, atoms[a][4:7], atoms[b][4:7])) / r
            word = philox((a, b, step & 0xFFFFFFFF, step >> 32), (SEED, 1))[0]
            noise = math.sqrt(12) * ((word + 0.5) / 2**32 - 0.5)
            force = (weight * repulsion * w if repels else 0) - weight * friction * w * w * approach
            force += math.sqrt(weight * 2 * friction * temperature / dt) * w * noise
            self.energy += weight * 0.5 * repulsion * cutoff * w * w if repels else 0
            self.virial += force * r
            self.count += 1
            for axis, d in enumerate(apart):
                self.forces[a][axis] += force * d / r
                self.forces[b][axis] -= force * d / r


class Forces(unittest.TestCase):

    def compare(self, script, step=0, temperature=1.0, ranks=1, newton="on", lists="", **options):
        found, output = atoms_after(FLUID + script, ranks, newton, lists)
        expected = AllPairs(found, step, temperature, **options)
        self.assertGreater(expected.count, 1000)
        for atom, row in found.items():
            for axis in range(3):
                self.assertAlmostEqual(row[7 + axis], expected.forces[atom][axis], delta=1e-9)
        thermo = thermo_tables(output)[-1][-1]
        count = len(found)
        self.assertAlmostEqual(thermo["E_pair"], expected.energy / count, delta=1e-11)
        pressure = (count * thermo["Temp"] * (count - 1) / count + expected.virial / 3) / SIDE**3
        self.assertAlmostEqual(thermo["Press"], pressure, delta=1e-9)

    def test_against_all_pairs(self):
        for lists in ("", "dch on\n"):
            for newton, ranks in (("on", 1), ("off", 1), ("on", 2), ("off", 2)):
                with self.subTest(lists=lists, newton=newton, ranks=ranks):
                    self.compare(DPD + "run 0\n", lists=lists, newton=newton, ranks=ranks)

    def test_steps_beyond_32_bits(self):
        self.compare(f"reset_timestep {2**32 + 5}\n{DPD}run 0\n", step=2**32 + 5)

    def test_the_time_step_counts(self):
        self.compare(DPD + "timestep 0.002\nrun 0\n", dt=0.002)

    def test_weights_of_bonded_atoms(self):
        """The random force has the root of the weight of drag."""
        bonds = [(k, k + 1) for k in range(1, 200, 2)]
        made = "".join(f"create_bonds single/bond 1 {a} {b} special {'yes' if b == 200 else 'no'}\n" for a, b in bonds)
        script = BOND + DPD + "special_bonds lj 0.3 1.0 1.0\n" + made + "run 0\n"
        self.compare(script, weights={pair: 0.3 for pair in bonds})

    def test_tstat_ramps_the_temperature(self):
        coefficients = "".join(f"pair_coeff {a} {b} {f} {c}\n" for (a, b), (_, f, c) in PAIRS.items())
        style = f"pair_style dpd/tstat/philox 0.5 2.5 1.0 {SEED}\n{coefficients}fix 1 all nve\n"
        self.compare(style + "run 0\n", temperature=0.5, repels=False)
        # At the end of 20 steps forces are of velocities half a step before: without drag these do not matter.
        at_rest = style.replace("4.5", "0.0").replace("6.5", "0.0").replace("2.0 0.8", "0.0 0.8")
        found, _ = atoms_after(FLUID + at_rest + "run 20\n")
        self.assertTrue(all(number == 0.0 for row in found.values() for number in row[7:]))
        still = style.replace("fix 1 all nve\n", "velocity all set 0 0 0\n")
        found, _ = atoms_after(FLUID + still + "run 20\n")
        expected = AllPairs(found, 20, 2.5, repels=False)
        for atom, row in found.items():
            for axis in range(3):
                self.assertAlmostEqual(row[7 + axis], expected.forces[atom][axis], delta=1e-9)

    def test_beside_another_style(self):
        """As a thermostat of Lennard-Jones atoms, the sum of both."""
        lj = "pair_coeff * * lj/cut 0.01 0.3\n"
        tstat = f"pair_coeff * * dpd/tstat/philox 4.5\n"
        forces = []
        for style in (f"hybrid/overlay lj/cut 0.9 dpd/tstat/philox 1.0 1.0 1.0 {SEED}\n{lj}{tstat}",
                      "lj/cut 0.9\npair_coeff * * 0.01 0.3\n",
                      f"dpd/tstat/philox 1.0 1.0 1.0 {SEED}\npair_coeff * * 4.5\n"):
            forces.append(atoms_after(f"{FLUID}pair_style {style}run 0\n", numbers="fx fy fz")[0])
        both, first, second = forces
        for atom, row in both.items():
            for axis in (1, 2, 3):
                scale = abs(first[atom][axis]) + abs(second[atom][axis])
                self.assertAlmostEqual(row[axis], first[atom][axis] + second[atom][axis], delta=1e-11 * (1 + scale))


class Motion(unittest.TestCase):

    def assert_near(self, first, second, delta):
        self.assertEqual(first.keys(), second.keys())
        for atom, row in first.items():
            for k, (a, b) in enumerate(zip(row, second[atom])):
                if k in (1, 2, 3):  # positions, wrapped
                    a -= SIDE * round((a - b) / SIDE)
                self.assertAlmostEqual(a, b, delta=delta)

    def test_same_on_any_number_of_processes(self):
        """Whatever finds pairs, and whichever of two processes computes one."""
        script = fluid_from_file() + DPD + "run 30\n"
        alone, _ = atoms_after(script)
        for ranks, newton, lists in ((1, "on", "dch on\n"), (2, "on", "dch on\n"), (4, "on", ""), (2, "off", "dch on\n"),
                                     (4, "off", "dch on\n"), (1, "off", "")):
            with self.subTest(ranks=ranks, newton=newton, lists=lists):
                # 1e-15 at the start, and about e^0.3 times as much a step at this density.
                self.assert_near(alone, atoms_after(script, ranks, newton, lists)[0], 1e-8)

    def test_momentum_stays(self):
        for ranks, newton in ((1, "on"), (2, "off")):
            found, _ = atoms_after(f"{FLUID}{DPD}run 200\n", ranks, newton, "dch on\n")
            for axis in (4, 5, 6):
                self.assertAlmostEqual(sum(row[axis] for row in found.values()), 0, delta=1e-10)

    def test_restart(self):
        """Seed, step and coefficients are the only state."""
        start, later = fluid_from_file(), host.work / "later.restart"
        straight, _ = atoms_after(start + DPD + "run 20\nrun 20\n")
        for ranks_before, ranks_after in ((1, 1), (1, 4), (4, 2)):
            run(f"include ${{load}}\n{start}{DPD}run 20\nwrite_restart {later}\n", ranks=ranks_before,
                variables={"newton": "on"})
            after = start.replace("fluid.restart", "later.restart") + "fix 1 all nve\nrun 20\n"
            self.assert_near(straight, atoms_after(after, ranks_after)[0], 1e-8)

    def test_data_file(self):
        file = host.work / "fluid.data"
        found, _ = atoms_after(f"{FLUID}{BOND}{DPD}run 0\nwrite_data {file} pair ij nofix\n", numbers="fx fy fz")
        script = f"newton ${{newton}}\natom_style bond\nbond_style zero\ncomm_modify vel yes\n" \
            f"pair_style dpd/philox 1.0 1.0 {SEED}\nread_data {file}\nneighbor 0.3 bin\ntimestep 0.01\nrun 0\n"
        again, _ = atoms_after(script, numbers="fx fy fz")
        for atom, row in found.items():
            self.assertTrue(all(abs(a - b) < 1e-7 for a, b in zip(row[1:], again[atom][1:])))

    def test_single_is_the_repulsion(self):
        sums = "compute each all pair/local eng\ncompute sum all reduce sum c_each INPUTS_LOCAL\nthermo_style custom step pe c_sum\n"
        _, output = atoms_after(f"{FLUID}{DPD}{sums}thermo_modify norm no format float %.15g\nrun 0\n")
        row = thermo_tables(output)[-1][0]
        self.assertAlmostEqual(row["PotEng"], row["c_sum"], delta=1e-9)


class Statistics(unittest.TestCase):
    """The fluid of Groot and Warren (1997), repulsion 25 and density 3, beside the same repulsion in the bath of fix langevin:
    averages of 500 steps. Of eight seeds temperature, pressure and energy had standard deviations of 0.007, 0.03 and 0.005."""

    def means(self, friction, bath):
        script = FLUID.replace("375", "3000").replace(f"0 {SIDE}", "0 10") + f"""
        pair_style dpd/philox 1.0 1.0 {SEED}
        pair_coeff * * 25.0 {friction}
        fix 1 all nve
        {bath}
        run 500
        fix mean all ave/time 1 500 500 c_thermo_temp c_thermo_press c_thermo_pe
        thermo 500
        thermo_style custom step f_mean[1] f_mean[2] f_mean[3]
        run 500
        """
        _, output = atoms_after(script, lists="dch on\n")
        row = thermo_tables(output)[-1][-1]
        return [row[f"f_mean[{k}]"] for k in (1, 2, 3)]

    def test_drag_and_random_forces_keep_the_temperature(self):
        by_pairs = self.means(4.5, "")
        self.assertAlmostEqual(by_pairs[0], 1.0, delta=0.04)
        by_atoms = self.means(0.0, f"fix 2 all langevin/philox 1.0 1.0 0.5 {SEED}")
        self.assertAlmostEqual(by_pairs[1], by_atoms[1], delta=0.25)
        self.assertAlmostEqual(by_pairs[2], by_atoms[2], delta=0.03)


class Refused(unittest.TestCase):
    """What it does not take: the value, what would be right, and what to do."""

    def refuse(self, words, message, before="", coefficients="pair_coeff * * 25.0 4.5\n", fluid=FLUID):
        code, output = host.run_text(f"include ${{load}}\n{before}{fluid}pair_style {words}\n{coefficients}run 0\n",
                                     variables={"newton": "on"})
        self.assertNotEqual(code, 0)
        self.assertRegex(output, r"ERROR.*: Pair style dpd/(tstat/)?philox: ")
        self.assertRegex(" ".join(output.split()), message)

    def test_numbers(self):
        self.refuse("dpd/philox 1.0 1.0", "a temperature, a cutoff and a seed are wanted, but 2 words given")
        self.refuse("dpd/tstat/philox 1.0 1.0 7", "two temperatures, a cutoff and a seed are wanted, but 3 words given")
        self.refuse("dpd/philox -1.0 1.0 7", "temperature is '-1.0' but has to be a number of 0 or more")
        self.refuse("dpd/philox 1.0 nan 7", "cutoff is 'nan' but has to be a number of 0 or more")
        for seed in ("0", "-7", "1.5", "2147483648", "x"):
            self.refuse(f"dpd/philox 1.0 1.0 {seed}", f"seed is '{seed}' but has to be a whole number from 1 to 2147483647")
        good = "dpd/philox 1.0 1.0 7"
        self.refuse(good, "pair_coeff wants two types, repulsion, friction", coefficients="pair_coeff * * 25.0\n")
        self.refuse(good, "repulsion is 'inf' but has to be a number", coefficients="pair_coeff * * inf 4.5\n")
        self.refuse(good, "friction is '-4' but has to be a number of 0 or more", coefficients="pair_coeff * * 25 -4\n")
        self.refuse(good, "types 1 and 2 have no pair_coeff; there is no mixing",
                    coefficients="pair_coeff 1 1 25 4.5\npair_coeff 2 2 25 4.5\n")
        if host.year < 2023:  # later versions turn the types round
            self.refuse(good, "pair_coeff 2 1 names no pair of types", coefficients="pair_coeff 2 1 25 4.5\n")

    def test_settings(self):
        good = "dpd/philox 1.0 1.0 7"
        self.refuse(good, "give 'comm_modify vel yes'", fluid=FLUID.replace("vel yes", "vel no"))
        self.refuse("dpd/philox 1.0 2.6 7", "the box is 5.0+ wide along axis 1, less than twice the cutoff of 2.6")
        no_ids = FLUID.replace("atom_style bond", "atom_style atomic\natom_modify id no").replace("velocity", "#").replace(
            " bond/types 1 extra/bond/per/atom 1 extra/special/per/atom 1", "")
        self.refuse(good, "give 'atom_modify id yes'", fluid=no_ids)


if __name__ == "__main__":
    main(__doc__)

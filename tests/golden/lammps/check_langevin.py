#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""fix langevin/philox in a real LAMMPS, beside fix langevin and beside a gas that is moved here."""

import math
import re
import unittest

from lammps_run import thermo_tables
from langevin_oracle import Gas
from script_tests import MELT, host, main, run

SEED = 904297
GAS = """
units lj
atom_style atomic
atom_modify sort 5 1.0
lattice fcc 0.8442
region box block 0 ${size} 0 ${size} 0 ${size}
create_box 2 box
create_atoms 1 box
set type 1 type/fraction 2 0.5 881
mass 1 1.0
mass 2 1.7
pair_style none
comm_modify cutoff 2.0
neigh_modify delay 0 every 4 check no
"""
BATH = f"fix 1 all nve\nfix 2 all langevin/philox 1.3 1.3 0.5 {SEED}\n"


def atoms_after(script, ranks=1, size=4, numbers="vx vy vz fx fy fz"):
    """Numbers of atoms by ID after the last step, with every bit."""
    dump = host.work / "dump.langevin"
    run(f"include ${{load}}\n{script}write_dump all custom {dump} id type {numbers} "
        "modify sort id format float %.17g\n", ranks=ranks, variables={"size": size})
    rows = [line.split() for line in dump.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]]
    return {int(row[0]): (int(row[1]), *map(float, row[2:])) for row in rows}


def gas_from_file():
    """The gas, with IDs that do not depend on the number of processes that read it."""
    file = host.work / "gas.restart"
    run(f"{GAS}write_restart {file}\n", variables={"size": 4})
    return f"read_restart {file}\npair_style none\ncomm_modify cutoff 2.0\n"


class Forces(unittest.TestCase):
    """Every bit of velocities and forces, of a gas that has no other forces."""

    def compare(self, script, gas_options, steps):
        found = atoms_after(GAS + script, size=2)
        gas = Gas({atom: row[0] for atom, row in found.items()}, SEED, **gas_options)
        gas.move(steps)
        self.assertEqual(gas.atoms(), found)
        return found

    def test_at_a_constant_temperature(self):
        found = self.compare(BATH + "run 20\n", {"damping": 0.5, "temperature": lambda step: 1.3}, 20)
        self.assertEqual({row[0] for row in found.values()}, {1, 2})

    def test_ramp_and_scale(self):
        script = BATH.replace("1.3 1.3", "0.5 2.5").replace(str(SEED), f"{SEED} scale 2 3.5")
        self.compare(script + "run 20\n", {"damping": 0.5, "temperature": lambda step: 0.5 + step / 20 * 2.0,
                                           "ratios": (1.0, 3.5)}, 20)

    def test_a_variable(self):
        script = "variable t equal 1+step/64\n" + BATH.replace("1.3 1.3", "v_t 1.3")
        self.compare(script + "run 20\n", {"damping": 0.5, "temperature": lambda step: 1 + step / 64}, 20)

    def test_steps_beyond_32_bits(self):
        self.compare(f"reset_timestep {2**32 + 5}\n" + BATH + "run 3\n",
                     {"damping": 0.5, "temperature": lambda step: 1.3, "first_step": 2**32 + 5}, 3)

    def test_a_time_step_that_changes_on_the_way(self):
        found = atoms_after(GAS + BATH + "fix 3 all dt/reset 1 0.001 0.002 1.0 units box\nrun 3\n", size=2)
        gas = Gas({atom: row[0] for atom, row in found.items()}, SEED, 0.5, lambda step: 1.3)
        gas.dt = 0.002  # from behind the first forces on
        gas.move(3)
        self.assertEqual(gas.atoms(), found)

    def test_same_on_any_number_of_processes(self):
        for keywords in ("", "zero yes"):
            script = gas_from_file() + BATH.replace(str(SEED), f"{SEED} {keywords}") + "run 40\n"
            alone = atoms_after(script)
            for ranks in (2, 4):
                self.assertTrue(alone == atoms_after(script, ranks), f"{ranks} {keywords}")

    def test_atoms_of_a_group_wherever_they_stand(self):
        whole = atoms_after(GAS + BATH + "run 20\n")
        for words in ("id 1:1000:2", "id 1:1000:17", "type 2", "id 3", "id 20:200"):
            script = GAS + f"group some {words}\n" + BATH.replace("2 all", "2 some") + "run 20\n"
            part = atoms_after(script)
            members = {atom for atom, row in part.items() if any(row[1:])}
            self.assertEqual({atom: whole[atom] for atom in members}, {atom: part[atom] for atom in members})
            self.assertLess(len(members), len(whole))
            self.assertGreater(len(members), 0)

    def test_zero_takes_the_mean_force_away(self):
        plain = atoms_after(GAS + BATH + "run 0\n")
        bath = BATH.replace(str(SEED), f"{SEED} zero yes")
        for group, types in (("all", (1, 2)), ("light", (1,))):
            zeroed = atoms_after(GAS + "group light type 1\n" + bath.replace("2 all", f"2 {group}") + "run 0\n")
            members = [atom for atom, row in plain.items() if row[0] in types]
            for axis in (4, 5, 6):
                mean = sum(plain[atom][axis] for atom in members) / len(members)
                self.assertGreater(abs(mean), 1e-3)
                for atom in members:
                    self.assertAlmostEqual(zeroed[atom][axis], plain[atom][axis] - mean, delta=1e-12)


class AskedByOthers(unittest.TestCase):
    """Commands and fixes that know fix langevin by its name ask for the temperature, or set it."""

    def test_replicas_swap_temperatures(self):
        script = MELT.replace("0 6 0 6 0 6", "0 4 0 4 0 4").replace("create 1.44", "create ${hot}") + (
            f"fix 2 all langevin/philox ${{t}} ${{t}} 0.1 {SEED}\ntimestep 0.002\n"
            "thermo 50\nthermo_modify flush yes\ntemper 400 50 ${t} 2 3847 58382\n")
        worlds = "include ${load}\nvariable t world 0.5 2.0\nvariable hot world 5.0 0.2\n"
        output = run(worlds + script, ranks=2, executable=[host.lmp, "-partition", "2x1"])
        last = [line.split() for line in output.splitlines() if re.fullmatch(r" *\d+ [01] [01] *", line)][-1]
        self.assertEqual(last, ["400", "1", "0"])
        found = [thermo_tables((host.work / f"screen.{world}").read_text())[-1][-1]["Temp"] for world in (0, 1)]
        self.assertGreater(found[0], 1.5)
        self.assertLess(found[1], 0.8)

    def test_a_fix_reads_the_temperature(self):
        script = GAS.replace("atomic", "charge").replace("pair_style none", "pair_style lj/cut 1.0\npair_coeff * * 0.0 1.0")
        output = run("include ${load}\n" + script + f"fix 1 all nve\nfix 2 all langevin/philox 1.0 1.0 0.5 {SEED}\n"
                     "fix 3 all charge/regulation 1 2 acid_type 1 pH 7 pKa 6 pIp 3 pIm 3 tempfixid 2 seed 2345 nevery 10\n"
                     "fix_modify 3 energy no\nrun 20\n", variables={"size": 3})
        self.assertIn("Loop time", output)


class WithoutNoise(unittest.TestCase):
    """At a temperature of 0 only drag is left: the bits of fix langevin."""

    def test_bits_of_langevin(self):
        two = MELT.replace("create_box 1", "create_box 2").replace(
            "mass 1 1.0", "set type 1 type/fraction 2 0.5 881\nmass 1 1.0\nmass 2 1.7").replace("coeff 1 1", "coeff * *")
        groups = "group odd type 2\n"
        for group, keywords, ranks in (("all", "", 1), ("all", "scale 2 0.7 zero yes", 2), ("odd", "", 1), ("odd", "", 4)):
            script = two + groups + f"fix 2 {group} langevin 0.0 0.0 2.0 {SEED} {keywords}\nrun 40\n"
            numbers = "x y z vx vy vz fx fy fz"
            stock = atoms_after(script, ranks, numbers=numbers)
            self.assertEqual(stock, atoms_after(script.replace("langevin", "langevin/philox"), ranks, numbers=numbers))

    def test_in_units_with_factors(self):
        script = MELT.replace("units lj", "units real").replace("fcc 0.8442", "fcc 5.26").replace(
            "create 1.44", "create 120").replace("lj/cut 2.5", "lj/cut 8.5").replace("1.0 1.0", "0.238 3.405").replace(
                "mass 1 1.0", "mass 1 39.95").replace("0.3 bin", "1.0 bin")
        script += f"fix 2 all langevin 0.0 0.0 50.0 {SEED}\nrun 20\n"
        self.assertEqual(atoms_after(script), atoms_after(script.replace("langevin", "langevin/philox")))


class BesideOthers(unittest.TestCase):
    """Restarts, the order of atoms, the suffix."""

    def test_restart(self):
        """Seed and step are the only state. As at every start of a run, drag is taken from velocities of whole steps."""
        start, later = gas_from_file(), host.work / "later.restart"
        straight = atoms_after(start + BATH + "run 20\nrun 20\n")
        for ranks_before, ranks_after in ((1, 1), (1, 4), (4, 2)):
            run(f"include ${{load}}\n{start}{BATH}run 20\nwrite_restart {later}\n", ranks=ranks_before)
            after = start.replace("gas.restart", "later.restart") + BATH + "run 20\n"
            self.assertTrue(straight == atoms_after(after, ranks_after), (ranks_before, ranks_after))

    def test_order_of_the_structure(self):
        """`dch order auto` keeps LAMMPS's order of atoms if a fix draws random numbers in it; this one does not."""
        script = MELT.replace("every 5 check no", "every 1 check yes\natom_modify sort 10 0") + "dch on\n"
        for style, is_ordered in (("langevin", False), ("langevin/philox", True)):
            output = run(f"include ${{load}}\n{script}fix 2 all {style} 1.0 1.0 1.0 4711\nrun 60\ndch stats\n")
            self.assertEqual("atoms in memory         in the order of the structure" in output, is_ordered, style)


class Statistics(unittest.TestCase):
    """Velocities of a gas. They are a moving sum of the noise: with a = dt / (2 damping) and k T / m = 1, a velocity is
    half the last number and (1 - a) (1 - 2 a)^(j-1) times the one j steps before, each of variance 4 a. So its variance is 1, its
    correlation over k > 0 steps (1 - a) (1 - 2 a)^(k-1), and the excess of its fourth moment -6/5 of the sum of the
    fourth powers of its factors. Bounds are 5 standard deviations."""

    DAMPING, LAG, TEMPERATURE = 0.05, 5, 1.3

    @classmethod
    def setUpClass(cls):
        script = GAS + BATH.replace("0.5", str(cls.DAMPING))
        first = host.work / "dump.first"
        second = atoms_after(script + f"run 300\nwrite_dump all custom {first} id type vx vy vz modify sort id "
                             f"format float %.17g\nrun {cls.LAG} pre no\n", size=20)
        rows = [line.split() for line in first.read_text().split("ITEM: ATOMS")[-1].splitlines()[1:]]
        cls.pairs = []
        for row in rows:
            kind, *later = second[int(row[0])]
            unit = math.sqrt((1.0, 1.7)[kind - 1] / cls.TEMPERATURE)
            cls.pairs += [(unit * float(v), unit * w) for v, w in zip(row[2:], later[:3])]
        cls.a = 0.005 / (2 * cls.DAMPING)

    def assert_mean(self, values, expected, variance):
        count = len(values)
        self.assertGreater(count, 90000)
        self.assertAlmostEqual(sum(values) / count, expected, delta=5 * math.sqrt(variance / count))

    def test_mean(self):
        self.assert_mean([v for v, _ in self.pairs], 0, 1)

    def test_variance_is_the_temperature(self):
        self.assert_mean([v * v for v, _ in self.pairs], 1, 2)

    def test_third_and_fourth_moment(self):
        a = self.a
        fourth = 16 * a * a * (1 / 16 + (1 - a)**4 / (1 - (1 - 2 * a)**4))
        self.assert_mean([v**3 for v, _ in self.pairs], 0, 15)
        self.assert_mean([v**4 for v, _ in self.pairs], 3 - 1.2 * fourth, 96)

    def test_autocorrelation(self):
        a = self.a
        expected = (1 - a) * (1 - 2 * a)**(self.LAG - 1)
        self.assert_mean([v * w for v, w in self.pairs], expected, 1 + expected**2)

    def test_types_of_each_mass_have_the_temperature(self):
        for first in range(3):
            values = [v * v for v, _ in self.pairs[first::3]]
            self.assertAlmostEqual(sum(values) / len(values), 1, delta=5 * math.sqrt(2 / len(values)))


class Refused(unittest.TestCase):
    """What it does not take: the value, what would be right, and what to do."""

    def refuse(self, line, message, before="", after="run 0\n"):
        code, output = host.run_text("include ${load}\n" + before + GAS + line + "\n" + after, variables={"size": 2})
        self.assertNotEqual(code, 0)
        self.assertRegex(output, r"ERROR.*: Fix langevin/philox 2: ")
        self.assertRegex(output.replace("\n", " "), message)

    def refuse_words(self, words, message):
        self.refuse(f"fix 2 all langevin/philox {words}", message)

    def test_numbers(self):
        self.refuse_words("1.0 1.0", "two temperatures, the damping time and the seed are wanted")
        self.refuse_words("-1.0 1.0 0.5 1", "'-1.0' and '1.0' but have to be numbers of 0 or more")
        self.refuse_words("1.0 nan 0.5 1", "'1.0' and 'nan' but have to be numbers")
        self.refuse_words("1.0 1.0 -0.5 1", "damping time is '-0.5' but has to be a number > 0")
        self.refuse_words("1.0 1.0 0 1", "damping time is '0' but has to be a number > 0")
        for seed in ("0", "-7", "1.5", "2147483648", "x"):
            self.refuse_words(f"1.0 1.0 0.5 {seed}", f"seed is '{seed}' but has to be a whole number from 1 to 2147483647")

    def test_keywords(self):
        self.refuse_words("1.0 1.0 0.5 1 rotate yes", "unknown keyword 'rotate'; there are scale and zero")
        self.refuse_words("1.0 1.0 0.5 1 zero", "'zero' is followed by 0 of 1 values")
        self.refuse_words("1.0 1.0 0.5 1 zero maybe", "zero is 'maybe' but has to be yes or no")
        self.refuse_words("1.0 1.0 0.5 1 scale 1", "'scale' is followed by 1 of 2 values")
        for words in ("3 1.0", "0 1.0", "1.5 1.0", "nan 1.0", "1 0", "1 -2"):
            kind, ratio = words.split()
            self.refuse_words(f"1.0 1.0 0.5 1 scale {words}",
                              f"followed by '{kind}' and '{ratio}' but wants a type from 1 to 2 and a number > 0")
        for words in ("tally yes", "gjf vhalf", "omega yes", "angmom 3.333"):
            self.refuse_words(f"1.0 1.0 0.5 1 {words}", f"it has no '{words}'; use fix langevin")
        run("include ${load}\n" + GAS + BATH.replace(str(SEED), f"{SEED} tally no gjf no omega no angmom no") + "run 1\n",
            variables={"size": 2})

    def test_atoms_without_ids(self):
        self.refuse(BATH, "atoms have no IDs, on which random numbers depend; use fix langevin",
                    before="atom_modify id no\n")

    def test_masses_by_atom(self):
        gas = GAS.replace("atom_style atomic", "atom_style sphere").replace("mass 1 1.0\nmass 2 1.7\n", "")
        code, output = host.run_text("include ${load}\n" + gas + BATH + "run 0\n", variables={"size": 2})
        self.assertNotEqual(code, 0)
        self.assertIn("it does not know masses by atom; use fix langevin", output)

    def test_respa(self):
        self.refuse(BATH + "run_style respa 2 2 bond 1 pair 2", "does not know 'run_style respa'; use fix langevin")

    def test_bias(self):
        self.refuse(BATH + "compute t all temp/partial 1 1 0\nfix_modify 2 temp t", "no 'fix_modify temp'; use fix langevin")

    def test_variables(self):
        line = "fix 2 all langevin/philox v_t 1.0 0.5 1"
        self.refuse(line, "there is no variable 't' of style equal")
        self.refuse("variable t atom id\n" + line, "there is no variable 't' of style equal; .* use fix langevin")
        self.refuse("variable t equal 0.5-step\n" + line, "variable 't' is -0.5.* but has to be a temperature of 0 or more",
                    after="run 1\n")

    def test_zero_of_no_atoms(self):
        self.refuse("group none empty\nfix 2 none langevin/philox 1.0 1.0 0.5 1 zero yes",
                    "'zero yes' needs atoms, but its group has none")


if __name__ == "__main__":
    main(__doc__)

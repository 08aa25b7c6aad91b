# SPDX-License-Identifier: GPL-2.0-or-later
"""Random input scripts: a small system, then commands that change it in turns with runs.

Random numbers are drawn at the beginning of a script alone: LAMMPS makes them from the bits of coordinates. Lines that
begin with `dch` are for runs of ours alone. Numbers of atoms and steps are small, so that a script takes a few hundredths
of a second and rounding has no time to grow.
"""

import random

from random_bonds import WEIGHTS, BondActs
from random_pairs import PairStyles

FACES = {"p": 8, "f": 1, "s": 2, "m": 1}
LATTICES = {3: (("sc", 1), ("fcc", 4), ("bcc", 2)), 2: (("sq", 1), ("hex", 2))}


class Script(PairStyles, BondActs):
    """One script. `lines` holds it, `ranks` the number of processes that it wants."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines = []
        self.fixes = 0
        choose = self.random.choice
        self.ranks = choose((1, 2, 3, 4))
        self.dimension = choose((3, 3, 3, 3, 2))
        self.types = choose((1, 2, 2, 3))
        self.style = choose(("atomic", "atomic", "bond", "bond", "charge", "sphere"))
        self.newton = choose(("on", "on", "off", "on off" if self.style == "bond" else "off"))
        self.layout = choose(("brick", "brick", "tiled"))
        self.unequal = self.types > 1 and choose((True, False))
        self.faces = [self.random.choices(list(FACES), FACES.values())[0] for _ in range(3)]
        if self.dimension == 2:
            self.faces[2] = "p"
        self.prism = self.faces[1] == self.faces[2] == "p" and choose((True, False, False))
        self.keeps_order = self.ranks == 1
        self.soft = False
        self.begin()
        for _ in range(choose((2, 3, 4, 5, 6))):
            acts = self.random.sample(ACTS, choose((1, 1, 2)))
            for act in acts:
                act(self)
            self.run()

    def text(self, suffix, dch=""):
        """The script; with lines of `dch` that turn ours on, or else without any. A grid makes no cluster pairs for
        forces."""
        lines = [line for line in self.lines if dch or not line.startswith("dch ")]
        text = dch + "".join(line + "\n" for line in [f"suffix {suffix}", *lines])
        text = text.replace("dch again\n", dch)
        return text.replace("engine grid", "engine auto") if suffix == "dch" else text

    def add(self, *lines):
        self.lines += lines

    def seed(self):
        return self.random.randrange(1, 900000)

    def between(self, low, high):
        return f"{self.random.uniform(low, high):.4f}"

    def axis(self):
        return "xyz"[self.random.randrange(self.dimension)]

    def periodic(self):
        return [axis for axis, face in zip("xyz", self.faces) if face == "p" and "xyz".index(axis) < self.dimension]

    def seen(self):
        """What thermo prints. Nothing of a compute that has a list of its own: at the first step of a run LAMMPS takes
        such a list from the last step of the run before, whatever has changed in between."""
        self.add("thermo 4", "thermo_style custom step temp epair emol press pxx pyy pxy atoms",
                 "thermo_modify format float %.15g lost ignore norm no")

    def begin(self):
        """Box, atoms, bonds, pair style and settings."""
        uniform, choose, flat = self.random.uniform, self.random.choice, self.dimension == 2
        self.sizes = [1.0, uniform(1.5, 3) if self.unequal else 0.9, 0.8][:self.types]
        spacing = 10 ** uniform(0, 0.4) * max(self.sizes)
        density = 1.15 * spacing ** -self.dimension
        lattice, basis = choose(LATTICES[self.dimension])
        atoms = 10 ** uniform(1.5, 2.8)
        shape = [2 ** uniform(-1, 1) for _ in range(3)]
        cells = (atoms / basis) ** (1 / self.dimension)
        sides = [max(1, round(cells * s)) for s in shape[:self.dimension]]
        if self.ranks > 1 and flat:
            self.add("processors * * 1")
        room = "bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 60" if self.style == "bond" else ""
        self.add("units lj", f"newton {self.newton}", f"dimension {self.dimension}", f"boundary {' '.join(self.faces)}",
                 f"atom_style {self.style}", f"comm_style {self.layout}",
                 f"lattice {lattice} {density:.4f} origin 0.25 0.25 {0 if flat else 0.25}")
        depth = "-0.5 0.5" if flat else f"0 {sides[2]}"
        extent = f"0 {sides[0]} 0 {sides[1]} {depth}"
        if self.prism:
            tilt = [f"{uniform(-0.45, 0.45) * sides[0]:.3f}", *(["0", "0"] if flat else
                    [f"{uniform(-0.45, 0.45) * sides[0]:.3f}", f"{uniform(-0.45, 0.45) * sides[1]:.3f}"])]
            self.add(f"region box prism {extent} {' '.join(tilt)}")
        else:
            self.add(f"region box block {extent}")
        grains = self.style == "sphere"
        self.add(f"create_box {self.types} box {room}", "create_atoms 1 box",
                 *(["set group all density 1.0", "comm_modify vel yes"] if grains else ["mass * 1.0"]))
        shift = f"{0.06 * spacing:.4f}"
        self.add(f"displace_atoms all random {shift} {shift} {0 if flat else shift} {self.seed()}")
        for kind in range(2, self.types + 1):
            self.add(f"set group all type/fraction {kind} {self.between(0.02, 0.5)} {self.seed()}",
                     *[] if grains else [f"mass {kind} {self.between(1, 5)}"])
        if grains:
            self.add(*(f"set type {kind + 1} diameter {size:.4f}" for kind, size in enumerate(self.sizes)))
        self.add("group odd id 1:100000:2", "group few id 1:20", f"neighbor {self.between(0.1, 0.6)} bin")
        if self.style == "charge":
            self.add("set group all charge 0.5", "set group odd charge -0.5")
        if self.style == "bond":
            self.add("bond_style harmonic", "bond_coeff 1 10.0 1.0")
        self.pair()
        if self.style == "bond":
            self.add(f"create_bonds many all all 1 0.1 {min(2.0, spacing):.4f}",
                     f"special_bonds lj {choose(WEIGHTS)}")
        self.add(f"velocity all create {self.between(0.1, 2)} {self.seed()} loop geom")
        self.settings()
        self.add("timestep 0.002")
        self.move()
        self.seen()
        self.run()

    def move(self):
        self.add("fix move all nve" + "/sphere" * (self.style == "sphere" and self.dimension == 3),
                 *["fix flat all enforce2d"] * (self.dimension == 2))

    def run(self):
        steps = self.random.choice((0, 3, 5, 8, 12))
        how = self.random.choice(("", "", "", " pre no", " post no", " every"))
        if how == " every":
            self.add(f"run {2 * steps} every {max(1, steps)} \"print done\"")
        elif how == " pre no":
            self.add("run 2", f"run {steps} pre no")
        else:
            self.add(f"run {steps}{how}")

    def settings(self):
        """Lists are looked at so often that none lacks a pair within its cutoff: beyond that ours and LAMMPS's hold
        different pairs."""
        choose = self.random.choice
        every = choose((1, 1, 1, 2))
        self.keeps_order &= every == 1
        self.add(f"neigh_modify every {every} delay 0 check {choose(('yes', 'yes', 'no'))}")
        if choose((True, False, False)):
            self.add(f"comm_modify cutoff {self.between(3.0, 8.0)}")
        if choose((True, False, False)):
            self.add(f"atom_modify sort {choose((0, 1, 3))} 0.0")

    def engine(self):
        setting = self.random.choice(("on engine dch", "on engine grid", "on engine auto", "off", "on", "expiry half",
                                      "expiry exact", "expiry auto", "order yes", "order no", "order auto", "threads 2"))
        self.keeps_order &= setting not in ("expiry exact", "order yes")
        self.add(f"dch {setting}")

    def scale(self):
        axes = self.periodic()
        if axes:
            axis = self.random.choice(axes)
            self.add(f"change_box all {axis} scale {self.between(0.97, 1.1)} {self.random.choice(('', 'remap'))}")

    def tilt(self):
        if self.prism and "y" in self.periodic():
            self.add(f"change_box all xy delta {self.between(-0.3, 0.3)} remap")

    def kind_of_box(self):
        if not self.prism and self.faces[1] == self.faces[2] == "p":
            self.prism = True
            self.add("change_box all triclinic")

    def faces_of_box(self):
        k = self.random.randrange(self.dimension)
        if not self.prism and self.faces[k] == "p":
            self.faces[k] = self.random.choice("smf")
            self.add(f"change_box all boundary {' '.join(self.faces)}")

    def take_away(self):
        """Contacts of grains would be looked for among the atoms that stood there before, by LAMMPS too."""
        if self.style == "sphere":
            self.pair()
        where = self.random.choice(("group few", "group odd", f"region part{len(self.lines)}"))
        if where.startswith("region"):
            axis = self.axis()
            span = " ".join("0.1 0.45" if a == axis else "EDGE EDGE" for a in "xyz")
            self.add(f"region {where[7:]} block {span} units lattice")
        bonds = " bond yes" if self.style == "bond" else ""
        self.add(f"delete_atoms {where}{bonds}")

    def put_in(self):
        """Atoms anywhere, so that from here on only a soft potential takes them."""
        self.soft = True
        self.pair()
        self.add(f"create_atoms {self.random.randint(1, self.types)} random {self.random.choice((1, 10, 60))} "
                 f"{self.seed()} NULL")
        if self.dimension == 2:  # z is -1e-15 in the lattice and 0 here, and lists of LAMMPS in a prism lack such pairs
            self.add("set group all z 0.0")

    def displace(self):
        self.add("displace_atoms all " + self.random.choice((f"move 3.3 -1.7 {0 if self.dimension == 2 else 0.4}",
                                                             "ramp x 0.0 0.4 x 0.0 3.0 units box")))

    def other_types(self):
        if self.types > 1:
            kind = self.random.randint(1, self.types)
            self.add(f"set group {self.random.choice(('odd', 'few'))} type {kind}")

    def other_skin(self):
        styles = ["bin", "bin", "nsq"] + (["multi"] if self.types > 1 else [])
        self.add(f"neighbor {self.between(0.05, 0.8)} {self.random.choice(styles)}")
        self.settings()

    def exclude(self):
        self.add("neigh_modify exclude " + self.random.choice(("type 1 1", "group few few", "group odd few", "none")))

    def velocities(self):
        self.add(f"velocity all scale {self.between(0.1, 3)}")

    def balance(self):
        if self.ranks > 1:
            way = "rcb" if self.layout == "tiled" else f"shift {'xyz'[:self.dimension]} 5 1.02"
            if self.random.choice((True, False)):
                self.add(f"balance 1.0 {way}")
            else:
                self.fixes += 1
                self.add(f"fix balance{self.fixes} all balance 3 1.0 {way}")

    def fix_for_a_run(self, words):
        """A fix for one run. That which keeps atoms in the plane has to come after all others."""
        flat = self.dimension == 2
        self.fixes += 1
        self.add(*["unfix flat"] * flat, f"fix f{self.fixes} {words}", *["fix flat all enforce2d"] * flat)
        self.run()
        self.add(f"unfix f{self.fixes}")

    def deform(self):
        axes = self.periodic()
        if axes:
            self.fix_for_a_run(f"all deform {self.random.choice((1, 2))} {self.random.choice(axes)} erate "
                               f"{self.between(-0.2, 0.5)} remap {self.random.choice(('x', 'none'))}")

    def shear(self):
        if self.prism and "y" in self.periodic() and self.layout == "brick":
            self.fix_for_a_run(f"all deform 1 xy erate {self.between(-0.5, 0.5)} remap v")

    def barostat(self):
        if len(self.periodic()) == self.dimension:
            self.add("unfix move")
            self.fix_for_a_run(f"all nph {self.random.choice(('iso', 'aniso'))} 1.0 1.0 1.0")
            self.add(*["unfix flat"] * (self.dimension == 2))
            self.move()

    def thermostat(self):
        """The random numbers of `fix langevin` go to the atoms in their order, which is LAMMPS's own on one process if no
        atoms are lost and lists are looked at each step."""
        if self.keeps_order and "f" not in self.faces:
            self.fix_for_a_run(f"all langevin 1.0 1.0 0.5 {self.seed()}")
        else:
            self.fix_for_a_run("all temp/rescale 2 1.0 1.0 0.02 0.5")

    def other_fix(self):
        self.fix_for_a_run(self.random.choice(("few setforce 0.0 0.0 0.0", "odd addforce 0.3 0.0 0.0",
                                               "all momentum 2 linear 1 1 1", "few spring/self 5.0",
                                               "all recenter INIT INIT NULL")))

    def walls(self):
        sides = [f"{axis}{end} EDGE" for axis, face in zip("xyz", self.faces) if face in "fs" for end in ("lo", "hi")]
        if sides:
            self.fix_for_a_run("all wall/reflect " + " ".join(sides))

    def minimize(self):
        self.add("min_style " + self.random.choice(("cg", "sd", "fire")), "minimize 0.0 0.0 6 12")

    def clock(self):
        self.add("reset_timestep 0")

    def more_copies(self):
        if self.random.choice((True, False, False)) and self.layout == "brick":
            axes = self.periodic()
            if axes:
                self.add("replicate " + " ".join("2" if a == axes[0] else "1" for a in "xyz"))

    def groups(self):
        self.add("group few clear", f"group few id 1:{self.random.choice((1, 50))}")


ACTS = [Script.engine, Script.engine, Script.scale, Script.tilt, Script.kind_of_box, Script.faces_of_box,
        Script.take_away, Script.put_in, Script.displace, Script.other_types, Script.other_skin, Script.exclude,
        Script.velocities, Script.pair, Script.balance, Script.deform, Script.shear, Script.barostat,
        Script.thermostat, Script.other_fix, Script.walls, Script.minimize, Script.clock, Script.more_copies,
        Script.groups, Script.weights, Script.cut_bonds, Script.tie_bonds, Script.break_bonds, Script.molecules,
        Script.levels, Script.levels, Script.restart]

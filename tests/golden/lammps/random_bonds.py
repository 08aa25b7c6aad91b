# SPDX-License-Identifier: GPL-2.0-or-later
"""What random scripts do to bonds, molecules and levels of time steps, and between a restart file and the next run."""

WEIGHTS = ("0 0 0", "0 1 1", "0.3 0.6 1.0", "1 1 1")


class BondActs:
    """For a Script; without bonds most of it does nothing."""

    def bonded(self):
        return self.style == "bond"

    def weights(self):
        if self.bonded():
            self.add(f"special_bonds lj {self.random.choice(WEIGHTS)}")

    def cut_bonds(self):
        if self.bonded():
            self.add(f"delete_bonds {self.random.choice(('few', 'odd'))} bond 1 remove special")

    def tie_bonds(self):
        if self.bonded():
            self.add("special_bonds lj 0 0 0", "create_bonds many few odd 1 0.1 1.2")
            self.weights()

    def break_bonds(self):
        if self.bonded() and self.newton == "on":
            self.fix_for_a_run(f"all bond/break 2 1 {self.between(0.9, 1.3)}")

    def molecules(self):
        if self.bonded():
            self.add("set group few mol 1", "set group odd mol 2",
                     f"neigh_modify exclude molecule/{self.random.choice(('intra', 'inter'))} all")

    def levels(self):
        bonds = "bond 1 " * self.bonded()
        ways = [f"2 2 {bonds}pair {2 if bonds else 1}"]
        if self.levels_within:
            first, second, third, last = (f"{part * self.levels_within:.4f}" for part in (0.5, 0.65, 0.75, 0.95))
            ways = [f"2 2 {bonds}inner 1 {first} {last} outer 2",
                     f"3 2 2 {bonds}inner 1 {first} {second} middle 2 {third} {last} outer 3"]
        self.add(f"run_style respa {self.random.choice(ways)}")
        self.run()
        self.add("run_style verlet")

    def restart(self):
        """What a restart file lacks is said again. Contacts of a pair style that has never run are not yet there."""
        self.add(*["run 0"] * (self.style == "sphere"), "write_restart random.restart", "clear", "dch again",
                 *["processors * * 1"] * (self.ranks > 1 and self.dimension == 2), f"comm_style {self.layout}",
                 "read_restart random.restart", f"neighbor {self.between(0.1, 0.6)} bin")
        self.keeps_order = False
        self.pair()
        self.settings()
        self.move()
        self.seen()

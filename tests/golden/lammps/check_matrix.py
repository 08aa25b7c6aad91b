#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Small and large particles under every way to send ghosts and to search for neighbors: the same thermo output as stock
LAMMPS, with lists and with force styles of ours, and every build verified.

A scene is a value for each factor; its run takes a hundredth of a second, so many of them share a process. In the
scenes meet, in a periodic box, each way to send ghosts with each neighbor style on each number of processes, and every
three values of three factors that LAMMPS lets meet. With --short: on one process, and every two values of two factors.
"""

import argparse
import itertools
import re
import sys
from collections import Counter

from batches import Runner, error_in
from lammps_run import Host, largest_relative_difference, thermo_tables

STEP_0_TOLERANCE = 1e-12
LAST_STEP_TOLERANCE = 1e-9
STEPS, EVERY = 12, 3

FACTORS = {
    "processes": (1, 2, 3, 4),
    "ghosts": ("mode single", "mode single cutoff 6.5", "mode multi", "mode multi cutoff/multi 1 2.5",
               "mode multi reduce/multi", "mode multi cutoff/multi 1 2.5 reduce/multi", "mode multi/old",
               "mode multi/old cutoff/multi/old 1 4.0", "group large"),
    "neighbor": ("bin", "nsq", "multi", "multi collection/type 2 2 1", "multi collection/type 1 *",
                 "multi collection/interval 2 2.2 6.5", "multi/old"),
    "layout": ("brick", "tiled"),
    "newton": ("on", "off", "off on"),
    "box": ("block", "prism"),
    "boundary": ("p p p", "p p s", "f s p", "f f f"),
    "pair": ("lj", "granular", "hybrid", "full"),
    "bonds": ("none", "left out", "weighted"),
    "engine": ("dch", "grid", "auto"),
}

# Tilts xy, xz, yz are whole spacings of the lattice. LAMMPS wants the second dimension of each to be periodic; faces
# marked f stay upright, or atoms of the lattice would be beyond them, and lost.
TILTS = {"p p p": (3.5, 1.75, -3.5), "p p s": (3.5, 0, 0), "f s p": (0, 0, -3.5), "f f f": (0, 0, 0)}
EDGE = 14.0
LARGE = ((0.04, 0.5, 0.5), (0.68, 0.5, 0.5), (0.5, 0.04, 0.07), (0.5, 0.52, 0.07))  # in the coordinates of the box

# The large ones are within the cutoff of each other and of small ones through faces and edges. Atoms are made and bonds
# tied with LAMMPS's simplest settings.
ATOMS = """
units lj
newton {newton}
boundary {boundary}
atom_style {style}
comm_style {layout}
lattice sc 0.186588921282799 origin 0.5 0.5 0.5
region box {box} units box
create_box 2 box {room}
create_atoms 1 box
{large}
{masses}
group small type 1
group large type 2
pair_style zero 5.9
pair_coeff * *
{bond_style}
delete_atoms overlap 2.6 small large
{bonds}
displace_atoms small random 0.15 0.15 0.15 4711
velocity all create 4.0 87287 loop geom
"""

MOTION = """
neigh_modify delay 0 every {every} check no
timestep 0.004
fix 1 all {integrator}
thermo {steps}
thermo_style custom step temp epair emol press
thermo_modify format float %.15g lost ignore norm no
"""

LJ = ("pair_coeff 1 1 {0} 1.0 0.5 1.25\npair_coeff 1 2 {0} 1.0 2.75 3.1\npair_coeff 2 2 {0} 1.0 5.0 5.6\n"
      "pair_modify shift yes\n")
PAIRS = {
    "lj": "pair_style lj/cut 5.6\n" + LJ.format(""),
    "granular": "pair_style gran/hooke/history 200.0 NULL 50.0 NULL 0.5 0\npair_coeff * *\n",
    "hybrid": "pair_style hybrid lj/cut 5.6 morse 3.1\n" + LJ.format("lj/cut") +
              "pair_coeff 1 1 morse 0.2 3.0 0.7 1.25\n",
    "full": "pair_style hybrid/overlay lj/cut 5.6 sw\n" + LJ.format("lj/cut") + "pair_coeff * * sw small.sw A A\nUNTRIMMED\n",
}
SW = "A A A 0.2 0.7 1.8 21.0 1.2 -0.333333333333 7.049556277 0.6022245584 4.0 0.0 0.0\n"

# Unverified builds have to be right by themselves: what verifying does to LAMMPS, bins for example, may help them.
MODES = {
    "lists": ("suffix off\n", "dch on engine {engine}\n"),
    "lists, verified": ("suffix off\n", "dch on engine {engine}\ndch verify yes\n"),
    "forces": ("suffix dch\n", "dch off\n"),
    "forces, verified": ("suffix dch\ndch verify yes\n", "dch off\n"),
    "both, verified": ("suffix dch\ndch verify yes\n", "dch on engine {engine_with_forces}\n"),
}


def is_possible(scene):
    """Whether LAMMPS takes these values together, for scenes with some of the factors too."""
    def has(factor, *starts):
        return str(scene.get(factor, "")).startswith(starts)

    known = scene.keys()
    if {"ghosts", "neighbor"} <= known:
        modes = {"mode multi/old": scene["neighbor"] == "multi/old",
                 "mode multi": has("neighbor", "multi") and scene["neighbor"] != "multi/old"}
        for mode, fits in modes.items():
            if (scene["ghosts"] + " ").startswith(mode + " ") and not fits:
                return False
    reduced = "reduce/multi" in scene.get("ghosts", "")
    return not (reduced and (has("newton", "off") or has("pair", "full"))  # LAMMPS refuses it
                or has("pair", "full") and has("newton", "off")  # as does sw
                or has("pair", "granular") and has("bonds", "left", "weighted")  # the atom style has none
                or has("ghosts", "group") and has("bonds", "left", "weighted")  # bonds without ghosts are missing
                or has("layout", "tiled") and has("ghosts", "group")
                # The history of contacts with newton on needs the layout brick.
                or has("layout", "tiled") and has("pair", "granular") and (reduced or has("newton", "on")))


def meetings(scene, count):
    """The combinations of so many values that meet in a scene."""
    return set(itertools.combinations(sorted(scene.items()), count))


def complete(scene, missing, count):
    """The scene with these values, each further one that which brings most of the missing combinations."""
    for factor in (factor for factor in FACTORS if factor not in scene):
        choices = [{**scene, factor: value} for value in FACTORS[factor]]
        scene = max(filter(is_possible, choices), key=lambda choice: len(meetings(choice, count) & missing))
    return scene


def make_scenes(short):
    count = 2 if short else 3
    missing = set()
    for factors in itertools.combinations(sorted(FACTORS), count):
        for values in itertools.product(*(FACTORS[factor] for factor in factors)):
            if is_possible(dict(zip(factors, values))):
                missing.add(tuple(zip(factors, values)))
    combinations, scenes = len(missing), []
    starts = [{"processes": processes, "boundary": "p p p", "ghosts": ghosts, "neighbor": neighbor}
              for processes in FACTORS["processes"][:1 if short else None]
              for ghosts in FACTORS["ghosts"] for neighbor in FACTORS["neighbor"]]
    for start in itertools.chain(filter(is_possible, starts), map(dict, sorted(missing, key=str))):
        if len(start) == count and tuple(sorted(start.items())) not in missing:
            continue
        scenes.append(complete(start, missing, count))
        missing -= meetings(scenes[-1], count)
    return scenes, combinations


def describe(scene):
    return "; ".join(f"{factor} {value}" for factor, value in scene.items())


def script_of(scene, before, after):
    granular, bonds = scene["pair"] == "granular", scene["bonds"] != "none"
    xy, xz, yz = tilts = TILTS[scene["boundary"]] if scene["box"] == "prism" else (0, 0, 0)
    large = "\n".join(f"create_atoms 2 single {EDGE * a + xy * b + xz * c} {EDGE * b + yz * c} {EDGE * c} units box"
                      for a, b, c in LARGE)
    box = scene["box"] + f" 0 {EDGE}" * 3 + (" {} {} {}".format(*tilts) if scene["box"] == "prism" else "")
    room = "bond/types 1 extra/bond/per/atom 80 extra/special/per/atom 160" if bonds else ""
    text = ATOMS.format(
        newton=scene["newton"], boundary=scene["boundary"], layout=scene["layout"], box=box, room=room, large=large,
        style="sphere" if granular else "bond" if bonds else "atomic",
        masses="set type 1 diameter 1.7\nset type 2 diameter 5.4" if granular else "mass 1 1.0\nmass 2 50.0",
        bond_style="bond_style harmonic\nbond_coeff 1 20.0 2.8" if bonds else "",
        bonds="create_bonds many large small 1 2.6 2.9" if bonds else "")
    style, _, collections = scene["neighbor"].partition(" ")
    settings = [f"neighbor 0.3 {style}", f"neigh_modify {collections}" if collections else ""]
    if scene["ghosts"].startswith("group"):
        settings.append("atom_modify first large")
    settings.append(f"comm_modify {scene['ghosts']} vel {'yes' if granular else 'no'}")
    if bonds:
        settings.append("special_bonds lj " + ("0.0 0.0 1.0" if scene["bonds"] == "left out" else "0.3 0.6 1.0"))
    motion = MOTION.format(every=EVERY, steps=STEPS, integrator="nve/sphere" if granular else "nve")
    return before + text + "\n".join(settings) + "\n" + PAIRS[scene["pair"]] + motion + after


def modes_of(scene):
    """The lines before and after the scene. A grid makes no cluster pairs; beside force styles `auto` takes its place."""
    engine = scene["engine"]
    with_forces = "auto" if engine == "grid" else engine
    return {name: (before, after.format(engine=engine, engine_with_forces=with_forces))
            for name, (before, after) in MODES.items() if scene["pair"] != "granular" or name.startswith(("lists", "both"))}


def wrong(scene, mode, stock, output):
    """What is not as it should be in a run of ours; empty if nothing is."""
    native, ours = thermo_tables(stock)[-1], thermo_tables(output)[-1]
    for k, allowed in ((0, STEP_0_TOLERANCE), (-1, LAST_STEP_TOLERANCE)):
        difference = largest_relative_difference(native[k], ours[k])
        if difference > allowed:
            return f"thermo output at step {ours[k]['Step']:g} differs by {difference:.3g}"
    if mode.endswith("verified"):
        verified = re.search(r"verified +(\d+) builds, (\d+) pairs, all equal", output)
        if scene["ghosts"].startswith("group"):
            if verified:
                return "lists are ours, though ghosts are of one group only"
        elif not verified or int(verified[1]) != STEPS // EVERY + 1 or int(verified[2]) == 0:
            return "not every build was verified"
    served = re.search(r": DCH$", output, re.MULTILINE)
    if bool(served) == scene["ghosts"].startswith("group"):
        return "lists that should be ours are not" if not served else "lists are ours that should be native"
    return ""


def check(host, scenes, ranks, runner):
    """Messages about what is wrong with the scenes, and what was counted."""
    messages, counts = [], Counter()
    stock, refused = runner.run({k: script_of(scene, "suffix off\n", f"run {STEPS}\n")
                                 for k, scene in enumerate(scenes)}, ranks, "")
    for k, output in refused.items():
        messages.append(f"stock LAMMPS: {error_in(output)}: {describe(scenes[k])}")
    runs = {(k, mode): script_of(scenes[k], before, after + f"run {STEPS}\ndch stats\n")
            for k in stock for mode, (before, after) in modes_of(scenes[k]).items()}
    # `clear` forgets styles of ours until a `dch` command is given.
    done, failed = runner.run({key: "dch precision double\n" + script for key, script in runs.items()}, ranks,
                              "include ${load}\n")
    for (k, mode), output in failed.items():
        messages.append(f"{mode}: {error_in(output)}: {describe(scenes[k])}")
    for (k, mode), output in done.items():
        if message := wrong(scenes[k], mode, stock[k], output):
            messages.append(f"{mode}: {message}: {describe(scenes[k])}")
        counts["runs"] += 1
        if verified := re.search(r"verified +(\d+) builds, (\d+) pairs", output):
            counts["builds"] += int(verified[1])
            counts["pairs"] += int(verified[2])
    return messages, counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    Host.add_arguments(parser)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--processes", type=int, nargs="+", default=FACTORS["processes"],
                        help="only the scenes on so many processes")
    arguments = parser.parse_args()
    host = Host(arguments)
    (host.work / "small.sw").write_text(SW)
    runner = Runner(host)
    scenes, combinations = make_scenes(arguments.short)
    messages, counts = [], Counter()
    scenes = [scene for scene in scenes if scene["processes"] in arguments.processes]
    for ranks in arguments.processes:
        found, counted = check(host, [scene for scene in scenes if scene["processes"] == ranks], ranks, runner)
        messages += found
        counts += counted
    for message in messages:
        print(message)
    print(f"{len(scenes)} scenes, with all of them {combinations} combinations of values, {counts['runs']} runs in "
          f"{runner.processes} processes, {counts['builds']} builds and {counts['pairs']} pairs verified, "
          f"{len(messages)} wrong")
    sys.exit(1 if messages else 0)


if __name__ == "__main__":
    main()

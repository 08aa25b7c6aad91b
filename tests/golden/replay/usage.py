# SPDX-License-Identifier: MIT
"""Wrong usage ends in exit status 2 and a message that names the option, its value and what to do; help does not.

    usage.py DCH FOLDER_OF_TRAJECTORIES
"""

import json
import os
import sys
import tempfile

from dch_command import Checks, expect_failure, run

SPHERES = ["hardspheres", "--spheres", "32", "--fraction", "0.2", "--time", "1"]


def wrong_commands(data):
    """(arguments, what the message has to hold). More than 60 lines: a table, a line a mistake."""
    water = os.path.join(data, "water.trr")
    polymer = os.path.join(data, "polymer.lammpstrj")
    outputs = ["--out", "lists.h5", "--report", "report.json", "--plot", "report.html"]

    def replay(*options):
        return ["replay", water, "--cutoff", "0.4", *outputs, *options]

    return [
        ([], ["no subcommand given", "Usage: dch", "replay", "--help"]),
        (["frobnicate"], ["unknown subcommand 'frobnicate'", "dchmd has info, replay, contacts", "--help"]),
        (["infos"], ["unknown subcommand 'infos' (did you mean info?)"]),
        (["repaly", water], ["unknown subcommand 'repaly' (did you mean replay?)"]),
        (["--frobnicate"], ["unknown option '--frobnicate'", "dchmd --help"]),
        (["help", "contact"], ["unknown subcommand 'contact' (did you mean contacts?)"]),
        (["help", "info", "all"], ["unknown subcommand 'all': dchmd info has none"]),
        (["replay", water, "--cutof", "0.4"], ["unknown option '--cutof' (did you mean --cutoff?)", "dchmd replay --help"]),
        (replay("--verfy=all"), ["unknown option '--verfy' (did you mean --verify?)"]),
        (replay("--cutoff", "0.3"), ["--cutoff is given more than once"]),
        (["info", water, polymer], [f"'{polymer}' is one argument too many"]),
        (["info", water, "--format", "xyz"], ["--format 'xyz'", "lammpstrj, dump"]),
        (["info", "-"], ["standard input", "--format", "lammpstrj"]),
        (replay("--threads", "0"), ["--threads '0'", "from 1 to 1024"]),
        (["replay", water, "--cutoff", "0.4", "--report", "-"], ["--report -", "standard output", "./-"]),
        (["convert", water, "-"], ["OUT -", "standard output"]),
        (["generate", "melt", "--chains", "10", "--beads", "10", "-"], ["OUT -", "standard output"]),
        *[(["replay", water, "--cutoff", "0.4", option, ""], [f"{option}: the name of the file is empty"])
          for option in ("--out", "--report", "--plot", "--topology")],
        *[(["contacts", polymer, "--gap", "1", option, ""], [f"{option}: the name of the file is empty"])
          for option in ("--out", "--report", "--plot", "--topology")],
        (["info", ""], ["FILE: the name of the file is empty"]),
        (["convert", water, ""], ["OUT: the name of the file is empty"]),
        (["generate", "melt", "--chains", "10", "--beads", "10", ""], ["OUT: the name of the file is empty"]),
        (replay("--engine", "cell", "--threads", "2"), ["--threads", "engine cell"]),
        (["replay"], ["FILE is required"]),
        (["replay", water], ["--cutoff is required"]),
        (replay("--frobnicate"), ["--frobnicate"]),
        (["replay", water, "--cutoff"], ["--cutoff needs a value"]),
        (["replay", water, "--cutoff", "-3", *outputs], ["--cutoff -3", "above 0"]),
        (["replay", water, "--cutoff", "0", *outputs], ["--cutoff 0", "above 0"]),
        (["replay", water, "--cutoff", "nan", *outputs], ["--cutoff 'nan'", "finite"]),
        (["replay", water, "--cutoff", "inf", *outputs], ["--cutoff 'inf'", "finite"]),
        (["replay", water, "--cutoff", "four", *outputs], ["--cutoff 'four'"]),
        (["replay", water, "--cutoff", "1e200", *outputs], ["--cutoff 1e200", "at most"]),
        (["replay", water, "--cutoff", "0.76", *outputs],
         [water, "frame 0", "0.76", "0.75", "half the smallest box height", "at most 0.75"]),
        (replay("--skin", "0.36"), [water, "frame", "0.76", "0.75"]),
        (replay("--skin", "-0.1"), ["--skin -0.1", "at least 0"]),
        (replay("--skin", "nan"), ["--skin 'nan'"]),
        (replay("--engine", "octree"), ["--engine 'octree'", "dch, grid, auto, cell, allpairs"]),
        (replay("--engine", "cell", "--policy", "repair"), ["--policy", "engine cell"]),
        (replay("--policy", "never"), ["--policy 'never'", "auto, repair, rebuild"]),
        (replay("--verify", "some"), ["--verify 'some'", "none, sample, all"]),
        (replay("--half", "--full"), ["--half", "--full"]),
        (replay("--exclude", "1-5"), ["--exclude '1-5'", "bonded, 1-2, 1-3, 1-4"]),
        (replay("--exclude", "bonded"), [water, "no molecule column", "--topology"]),
        (replay("--frames", "5:2"), ["--frames 5:2", "selects no frame"]),
        (replay("--frames", "0:10:0"), ["0:10:0", "step"]),
        (replay("--frames", "-5:"), ["'-5'", "first:end:step"]),
        (replay("--frames", "a:b"), ["'a'", "first:end:step"]),
        (replay("--frames", "100:200"), [water, "frame 100", "0 to 99"]),
        (["replay", polymer, "--cutoff", "3", "--report", "same", "--plot", "same"], ["--report and --plot", "same file"]),
        (["replay", polymer, "--cutoff", "3", "--out", polymer], ["FILE and --out", "same file"]),
        (["replay", polymer, "--cutoff", "3", "--topology", "t.bonds", "--report", "t.bonds"], ["--topology and --report"]),
        *wrong_contacts(data),
        (["info"], ["FILE is required"]),
        (["info", water, "--frames", "3:3"], ["3:3"]),
        (["convert", polymer], ["OUT is required"]),
        (["convert", polymer, polymer], ["IN and OUT", "same file"]),
        (["convert", polymer, "out.h5", "--frames", "42:"], ["frame 42", "0 to 41"]),
        (["generate"], ["dchmd generate needs a subcommand: melt"]),
        (["generate", "gas"], ["unknown subcommand 'gas'", "dchmd generate has melt"]),
        (["generate", "melt", "--chains", "0", "--beads", "10", "m.data"], ["--chains '0'", "from 1"]),
        (["generate", "melt", "--chains", "1.5", "--beads", "10", "m.data"], ["--chains '1.5'"]),
        (["generate", "melt", "--chains", "10", "--beads", "10", "--density", "0", "m.data"], ["--density 0"]),
        (["generate", "melt", "--chains", "10", "--beads", "10", "--seed", "-1", "m.data"], ["--seed '-1'"]),
        (["generate", "melt", "--chains", "1", "--beads", "2", "m.data"], ["box"]),
        (["generate", "melt", "--chains", "2147483647", "--beads", "2147483647", "m.data"], ["beads"]),
    ]


def wrong_contacts(data):
    polymer = os.path.join(data, "polymer.lammpstrj")
    water = os.path.join(data, "water.trr")

    def contacts(*options):
        return ["contacts", polymer, "--gap", "1", "--out", "contacts.h5", "--report", "report.json", "--plot", "page.html",
                *options]

    return [
        (["contacts"], ["FILE is required"]),
        (["contacts", polymer], ["--gap is required"]),
        (["contacts", polymer, "--gap", "-1"], ["--gap -1", "at least 0"]),
        (["contacts", polymer, "--gap", "nan"], ["--gap 'nan'", "finite"]),
        (["contacts", polymer, "--gap", "far"], ["--gap 'far'"]),
        (["contacts", polymer, "--gap", "30", "--out", "contacts.h5"],
         [polymer, "frame 0", "30", "half the smallest box height", "29.04"]),
        (contacts("--radius", "14.5"), [polymer, "frame 0", "twice the largest radius + gap = 30"]),
        (contacts("--radius", "-1"), ["--radius -1", "at least 0"]),
        (contacts("--radius", "1=0.5"), ["none for the type 3", "the id 2", "add 3=R"]),
        (contacts("--radius", "1=0.5,2=x"), ["--radius 'x'"]),
        (contacts("--skip-bonds", "-1"), ["--skip-bonds '-1'", "from 0"]),
        (contacts("--pairs", "some"), ["--pairs 'some'", "all, within, between"]),
        (contacts("--bins", "0"), ["--bins '0'", "from 1 to 4096"]),
        (contacts("--bins", "4097"), ["--bins '4097'"]),
        (contacts("--molecules", "1,x"), ["--molecules 'x'", "1,4-7"]),
        (contacts("--molecules", "64"), [polymer, "no molecule 64"]),
        (contacts("--chain-length", "40"), ["--chain-length 40", "1,714 atoms"]),
        (contacts("--chain-length", "2", "--molecules", "1"), ["--molecules", "give one of them"]),
        (contacts("--threads", "0"), ["--threads '0'", "from 1 to 1024", "number of threads"]),
        (contacts("--threads", "1025"), ["--threads '1025'"]),
        (contacts("--frames", "42:"), [polymer, "frame 42", "0 to 41"]),
        (["contacts", water, "--gap", "0.1", "--out", "contacts.h5"], [water, "no molecule column", "--topology"]),
        (["contacts", polymer, "--gap", "1", "--out", "same", "--plot", "same"], ["--out and --plot", "same file"]),
        (["contacts", polymer, "--gap", "1", "--topology", "t.chains", "--out", "t.chains"], ["--topology and --out"]),
    ]


def check_outputs_that_cannot_be(checks, command, data):
    water = os.path.join(data, "water.trr")
    polymer = os.path.join(data, "polymer.lammpstrj")
    with tempfile.TemporaryDirectory() as folder:
        for option in ("--out", "--report", "--plot"):
            for path, part in ((os.path.join(folder, "no", "such"), "No such file"), (folder, "a folder"),
                               ("/dev/null", "not a regular file")):
                expect_failure(checks, command, ["replay", water, "--cutoff", "0.4", option, path], 3, [path, part])
                expect_failure(checks, command, ["contacts", polymer, "--gap", "1", option, path], 3, [path, part])
        for option in ("--restart", "--report"):
            for path, part in ((os.path.join(folder, "no", "such"), "No such file"), (folder, "a folder")):
                expect_failure(checks, command, [*SPHERES, option, path], 3, [path, part])
        expect_failure(checks, command, [*SPHERES, "--every", "1", "--out", os.path.join(folder, "w.xyz")], 3, ["w.xyz", ".h5"])
        expect_failure(checks, command, ["convert", water, os.path.join(folder, "no", "w.h5")], 3, ["no/w.h5"])
        expect_failure(checks, command, ["convert", water, os.path.join(folder, "w.xyz")], 3, ["w.xyz", ".h5"])
        expect_failure(checks, command, ["generate", "melt", "--chains", "10", "--beads", "10",
                                         os.path.join(folder, "no", "m.data")], 3, ["no/m.data"])
    expect_failure(checks, command, ["replay", polymer, "--cutoff", "8", "--report", "new", "--plot", "./new"], 2,
                   ["--report and --plot", "same file"])


def check_full_disk(checks, command, data, chains):
    """Writing fails half-way: exit status 3, and no half-written file."""
    polymer = os.path.join(data, "polymer.lammpstrj")
    replay = ["replay", polymer, "--cutoff", "12", "--frames", "::4"]
    contacts = ["contacts", os.path.join(data, "nopbc.dcd"), "--gap", "5", "--topology", chains]
    for arguments in (contacts + ["--out", "contacts.h5"], contacts + ["--report", "report.json"],
                      contacts + ["--plot", "page.html"], replay + ["--out", "lists.h5"], replay + ["--report", "report.json"], replay + ["--plot", "page.html"],
                      ["convert", polymer, "out.h5"], ["convert", polymer, "out.lammpstrj"], [*SPHERES, "--restart", "state.json"],
                      [*SPHERES, "--report", "report.json"], [*SPHERES, "--every", "0.01", "--out", "frames.h5"],
                      ["generate", "melt", "--chains", "20", "--beads", "50", "melt.data"]):
        for largest_file in (0, 1000):
            message = expect_failure(checks, command, arguments, 3, [arguments[-1]], largest_file)
        print(message.strip(), flush=True)


def check_instruction_sets(checks, command, data):
    """DCH_FORCE_ISA: the same list from every set, and a message for a set that there is none of."""
    polymer = os.path.join(data, "polymer.lammpstrj")
    arguments = ["replay", polymer, "--cutoff", "6", "--frames", "::20", "--report", "report.json"]
    message = expect_failure(checks, command, arguments, 2, ["DCH_FORCE_ISA is 'mmx'", "choose one of", "portable"],
                             environment={"DCH_FORCE_ISA": "mmx"})
    sets = message.split("choose one of ")[1].strip().split(", ")
    hashes = set()
    for name in sets:
        with tempfile.TemporaryDirectory() as folder:
            result = run(command, *arguments, cwd=folder, environment={"DCH_FORCE_ISA": name})
            checks.that(result.returncode == 0, f"DCH_FORCE_ISA={name}: {result.stderr}")
            with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
                hashes.add(json.load(file)["list_hash"])
    checks.that(len(hashes) == 1, f"{', '.join(sets)} give {len(hashes)} different lists")


def check_help(checks, command):
    for arguments, parts in ((["--help"], ["dchmd replay FILE --cutoff R", "Exit status", "generate"]),
                             (["help"], ["dchmd replay FILE --cutoff R", "Exit status", "generate"]),
                             (["help", "contacts"], ["Usage: dchmd contacts", "--gap D"]),
                             (["help", "generate", "melt"], ["Usage: dchmd generate melt", "--chains"]),
                             (["replay", "--help"], ["--cutoff R", "nm for", "--verify"]),
                             (["info", "--help"], ["FILE"]),
                             (["hardspheres", "--help"], ["--fraction PHI", "--jam P", "--restart STATE.json"]),
                             (["contacts", "--help"], ["--gap D", "--topology", "--radius"]), (["convert", "--help"], ["H5MD"]),
                             (["generate", "melt", "--help"], ["--chains"])):
        result = run(command, *arguments)
        checks.that(result.returncode == 0, f"{arguments}: status {result.returncode}")
        for part in parts:
            checks.that(part in result.stdout, f"{arguments}: lacks {part!r}")
        longest = max(map(len, result.stdout.splitlines()))
        checks.that(longest <= 110, f"{arguments}: a line of {longest} characters")
    result = run(command, "--version")
    checks.that(result.returncode == 0 and result.stdout.startswith("dchmd ") and result.stdout.count(".") == 2,
                f"--version: {result.stdout!r}")


def main(command, data):
    checks = Checks()
    for arguments, parts in wrong_commands(data):
        message = expect_failure(checks, command, arguments, 2, parts)
        print(message.strip(), flush=True)
    check_outputs_that_cannot_be(checks, command, data)
    with tempfile.TemporaryDirectory() as folder:
        chains = os.path.join(folder, "one.chains")
        with open(chains, "w") as file:
            file.write("1-401\n")
        check_full_disk(checks, command, data, chains)
    check_instruction_sets(checks, command, data)
    check_help(checks, command)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])

# SPDX-License-Identifier: MIT
"""What the scripts beside it share: running programs, and running ours in turn with another."""

import json
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
INPUTS = os.path.join(HERE, "..", "inputs")
ROOT = os.path.join(HERE, "..", "..", "..")
FAILED, USAGE = 1, 2


def fail(message, code=FAILED):
    print(f"{os.path.basename(sys.argv[0])}: {message}", file=sys.stderr)
    sys.exit(code)


def need_program(name, package):
    if shutil.which(name) is None:
        fail(f"{name} is missing; install the Debian package {package}", USAGE)


def need_file(path, trajectory):
    if not os.path.exists(path):
        fail(f"{path} is missing; benchmarks/engine/make_trajectories {trajectory} makes it", USAGE)
    return os.path.abspath(path)


def run(command, folder, processor, refusal=None):
    """Output of a program that stays on one processor, and the share of it that the program had.

    If it ends badly and has printed what `refusal` matches, this is something that it cannot do, and no wrong answer.
    """
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_hwloc_base_binding_policy="none")
    before, start = processor_seconds(), time.monotonic()
    done = subprocess.run(["taskset", "-c", str(processor), *command], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        refused = refusal and re.search(refusal, done.stdout, re.MULTILINE)
        if refused:
            fail(f"{command[0]} refuses: {refused.group(0)}", USAGE)
        print(done.stdout[-2000:], file=sys.stderr)
        fail(f"{command[0]} ended with status {done.returncode}")
    return done.stdout, (processor_seconds() - before) / (time.monotonic() - start)


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="dch_peer_")


def processor_seconds():
    """Of all programs run so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def add_arguments(parser):
    parser.add_argument("--trajectories", default=os.path.join(ROOT, "build", "trajectories"),
                        help="folder filled by make_trajectories (default build/trajectories)")
    parser.add_argument("--repetitions", type=int, default=5, help="runs of which the median is taken (default 5)")
    parser.add_argument("--processor", type=int, default=0, help="processor to stay on (default 0)")
    parser.add_argument("--beside", metavar="PROGRAM",
                        help="dch_bench_table, to be run in turn with the peer; then the ratio is printed too")
    parser.add_argument("--lists", type=int, default=100, help="most configurations of a run of ours (default 100)")
    parser.add_argument("--scale", type=float, default=1, help="particles of scenes that are made, not read")
    parser.add_argument("--json", help="file for the times of all repetitions")


def written_scene(arguments, scene, folder):
    """What dch_bench_table says of a scene, and the file with the coordinates of its first configuration."""
    if not arguments.beside:
        fail("give dch_bench_table by --beside: it writes the scene", USAGE)
    run([os.path.abspath(arguments.beside), "--scenes", scene, "--write", folder, "--scale", str(arguments.scale),
         "--trajectories", os.path.abspath(arguments.trajectories)], folder, arguments.processor,
        refusal=r"^.* can be written$")
    with open(os.path.join(folder, scene + ".json"), encoding="utf-8") as file:
        return json.load(file), os.path.join(folder, scene + ".f64")


def our_time(arguments, scene, folder):
    """ns for one particle and list of the hierarchy, one repetition of the table."""
    report = os.path.join(folder, "table.json")
    run([os.path.abspath(arguments.beside), "--scenes", scene, "--only", "dch", "--repetitions", "1",
         "--trajectories", os.path.abspath(arguments.trajectories), "--processor", str(arguments.processor),
         "--lists", str(arguments.lists), "--scale", str(arguments.scale), "--json", report], folder, arguments.processor)
    with open(report, encoding="utf-8") as file:
        measurements = json.load(file)["scenes"][0]["measurements"]
    return next(m["median"] for m in measurements if m["contender"] == "dch")


def middle_and_least(times):
    return f"median {statistics.median(times):.1f}, least {min(times):.1f}"


def compare(arguments, scene, title, peer_time):
    """Runs peer_time(folder), and our program if asked for, in turn; prints ns for one particle and list."""
    theirs, ours = [], []
    with temporary_folder() as folder:
        for _ in range(arguments.repetitions):
            theirs.append(peer_time(folder))
            if arguments.beside:
                ours.append(our_time(arguments, scene, folder))
    report(arguments, scene, title, theirs, ours)


def report(arguments, scene, title, theirs, ours):
    """Prints the times of both, and writes them if asked to."""
    print(f"{scene}: {title}: {middle_and_least(theirs)} ns for one particle and list")
    if ours:
        ratio = statistics.median(a / b for a, b in zip(ours, theirs))
        print(f"{scene}: dch: {middle_and_least(ours)}; time of dch over theirs {ratio:.3f}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump({"scene": scene, "peer": title, "theirs": theirs, "ours": ours}, file, indent=1)

# SPDX-License-Identifier: MIT
"""Runs the command dchmd and checks what comes back; used by the scripts beside it."""

import json
import os
import random
import re
import resource
import subprocess
import sys
import tempfile


class Checks:
    """Counts what was checked and what failed; finish() ends the script accordingly."""

    def __init__(self):
        self.done = 0
        self.failed = 0

    def that(self, condition, message):
        self.done += 1
        if not condition:
            self.failed += 1
            print("FAILED:", message, flush=True)
        return condition

    def finish(self):
        print(f"{self.done} checks, {self.failed} failed")
        sys.exit(1 if self.failed or not self.done else 0)


def run(command, *arguments, timeout=600, cwd=None, largest_file=None, environment=None):
    """Runs the command to its end; with `largest_file`, writing more bytes to a file fails, as on a full disk.
    `environment` holds variables to set besides those of this process."""

    def limit():
        if largest_file is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

    # Python ignores SIGXFSZ, and so does the command then: the write itself fails
    return subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, cwd=cwd,
                          preexec_fn=limit, restore_signals=False, env={**os.environ, **(environment or {})})


def expect_failure(checks, command, arguments, status, parts, largest_file=None, environment=None):
    """The command ends with this status and a message of its own that holds all parts, and leaves no file behind."""
    with tempfile.TemporaryDirectory() as folder:
        result = run(command, *arguments, cwd=folder, largest_file=largest_file, environment=environment)
        what = "dchmd " + " ".join(map(str, arguments))
        checks.that(result.returncode == status, f"{what}: status {result.returncode}, not {status}: {result.stderr}")
        checks.that(result.stderr.startswith("dchmd: "), f"{what}: no message: {result.stderr!r}")
        for part in parts:
            checks.that(part in result.stderr, f"{what}: the message lacks {part!r}: {result.stderr}")
        checks.that(result.stdout == "", f"{what}: standard output: {result.stdout}")
        checks.that(os.listdir(folder) == [], f"{what}: left {os.listdir(folder)}")
    return result.stderr


def info(command, path):
    result = run(command, "info", "--json", path)
    if result.returncode != 0:
        raise SystemExit(f"dchmd info {path}: {result.stderr}")
    return json.loads(result.stdout)


def three_cutoffs(height):
    """0.1, 0.2 and 0.45 of the smallest box height, or 3, 6 and 10 where there is no box."""
    return [3.0, 6.0, 10.0] if height is None else [0.1 * height, 0.2 * height, 0.45 * height]


def replay(command, path, *options):
    """Status, report and standard error of a replay."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        result = run(command, "replay", path, "--report", report, *options)
        content = json.load(open(report)) if os.path.exists(report) else None
        return result, content


def run_example(checks, docs, folder, data, expected):
    """Runs the example of cli.md that reads a file of data in a folder and whose text holds what is expected of its output."""
    blocks = re.findall(r"```python\n(.*?)```", open(os.path.join(docs, "cli.md")).read(), re.DOTALL)
    example = next(block for block in blocks if data in block and expected in block)
    shown = subprocess.run([sys.executable, "-c", example], cwd=folder, capture_output=True, text=True)
    checks.that(shown.returncode == 0 and shown.stdout.strip() != "", f"the example of {data}: {shown}")
    print("the example of cli.md:", *shown.stdout.splitlines()[:3], sep="\n  ")
    return shown.stdout


def documented_keys(docs, command):
    """The table of report-schema.md for a subcommand: key -> when it is present."""
    sections = re.split(r"^## ", open(os.path.join(docs, "report-schema.md")).read(), flags=re.MULTILINE)
    text = next((section for section in sections if section.startswith(f"`dchmd {command}`")), "")
    keys = dict(re.findall(r"^\| `([^`]+)` \| [^|]+ \| ([a-z, ]+) \|", text, flags=re.MULTILINE))
    if not keys:
        raise SystemExit(f"report-schema.md: no table of keys for dchmd {command}")
    return keys


def keys_of(value, name=""):
    """Dotted names of all leaves; lists of objects as name[], other lists as leaves."""
    if isinstance(value, dict):
        return {key for k, v in value.items() for key in keys_of(v, f"{name}.{k}" if name else k)} | (
            {name} if not value else set())
    if isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
        return {name} | {key for v in value for key in keys_of(v, name + "[]")}
    return {name}


def write_chain(path, folded, frames=8, per_side=8, box=12.0):
    """A dump of one chain that shakes: folded, row by row and layer by layer, into a cube, or stretched in a zigzag."""
    number = random.Random(5)
    place = []
    for z in range(per_side):
        for y in range(per_side) if z % 2 == 0 else reversed(range(per_side)):
            row = range(per_side) if (y + z) % 2 == 0 else reversed(range(per_side))
            place.extend([float(x), float(y), float(z)] for x in row)
    if not folded:
        place = [[0.9 * k, 0.3 * (k % 2), 0.0] for k in range(len(place))]
        box = 1.1 * len(place)
    with open(path, "w") as file:
        for frame in range(frames):
            file.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{len(place)}\nITEM: BOX BOUNDS pp pp pp\n"
                       + f"0 {box!r}\n" * 3 + "ITEM: ATOMS id mol x y z\n")
            file.writelines(f"{k + 1} 1 {x!r} {y!r} {z!r}\n" for k, (x, y, z) in enumerate(place))
            place = [[x + number.uniform(-0.03, 0.03) for x in p] for p in place]


def check_keys(checks, report, docs, present, command="replay"):
    """The report holds the documented keys of these kinds and no others."""
    expected = {key for key, when in documented_keys(docs, command).items() if present & set(when.split(", "))}
    found = keys_of(report)
    checks.that(found == expected, f"report.json: undocumented {sorted(found - expected)}, "
                                   f"missing {sorted(expected - found)}")

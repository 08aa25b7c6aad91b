# SPDX-License-Identifier: MIT
"""Running the programs of a build, each on one processor."""

import json
import os
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import time

from .machine import ROOT


class Failed(Exception):
    """A program ended badly: with a wrong answer, or not at all."""


class Missing(Exception):
    """A program, package or file that a benchmark needs is not there; says what provides it."""


class Suite:
    """One run of one family: where things are, how much to do, and what was run."""

    def __init__(self, build, trajectories, size, processor):
        self.build = os.path.abspath(build)
        self.trajectories = os.path.abspath(trajectories)
        self.size = size
        self.processor = processor
        self.commands = []
        self.begin, self.processor_begin = time.monotonic(), processor_seconds()

    def pick(self, **by_size):
        """What is meant for this size: pick(tiny=1, quick=5, full=5)."""
        return by_size[self.size]

    def seconds(self):
        return time.monotonic() - self.begin

    def processor_seconds(self):
        """Spent by programs that have ended."""
        return processor_seconds() - self.processor_begin

    def program(self, *path):
        found = os.path.join(self.build, *path)
        if not os.path.exists(found):
            raise Missing(f"{os.path.join(*path)} is not in the build")
        return found

    def script(self, *path):
        return os.path.join(ROOT, "benchmarks", *path)

    def has_trajectory(self, name):
        return os.path.exists(os.path.join(self.trajectories, name))

    def needs_trajectory(self, scene):
        """Whether a scene cannot be had without its trajectory, which is not there."""
        return scene == "water30k" and not self.has_trajectory("water30k.trr")

    def run(self, command, environment=None, pinned=True, missing_status=None):
        """Standard output of a program. `missing_status` is the status by which it says that something is missing."""
        words = [str(word) for word in command]
        settings = [f"{name}={value}" for name, value in (environment or {}).items() if name.startswith("DCH_")]
        self.commands.append(shlex.join(settings + [shortened(word, self) for word in words]))
        if pinned:
            words = ["taskset", "-c", str(self.processor), *words]
        done = subprocess.run(words, env={**os.environ, "OMP_NUM_THREADS": "1", **(environment or {})}, cwd=ROOT,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
        if done.returncode == 0:
            return done.stdout
        message = f"{self.commands[-1]}: status {done.returncode}\n{done.stdout[-1500:].strip()}"
        raise Missing(message) if done.returncode == missing_status else Failed(message)

    def run_for_json(self, command, flag="--json", **how):
        """What a program writes to the file that it is given with `flag`."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "out.json")
            words = [*command, f"{flag}{path}"] if flag.endswith("=") else [*command, flag, path]
            self.run(words, **how)
            with open(path, encoding="utf-8") as file:
                return json.load(file)


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def shortened(word, suite):
    """For people: without this machine's folders."""
    for path, name in ((suite.build, "BUILD"), (suite.trajectories, "TRAJECTORIES"), (ROOT + os.sep, "")):
        word = word.replace(path, name)
    return re.sub(re.escape(tempfile.gettempdir()) + r"/\S+", "FILE", word)


def say(text):
    print(text, file=sys.stderr, flush=True)

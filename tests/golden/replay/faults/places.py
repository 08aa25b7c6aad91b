# SPDX-License-Identifier: MIT
"""Where outputs may go, the same for each of every subcommand: through links, not to devices, pipes and folders; a file
that is replaced keeps its permissions; a signal leaves nothing behind.

    places.py DCH FOLDER_OF_TRAJECTORIES
"""

import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from dch_command import Checks, run  # noqa: E402
from subcommands import OLD, SUBCOMMANDS, content, write_inputs  # noqa: E402


class Places:
    def __init__(self, checks, command, inputs, subcommand, output):
        self.checks, self.command, self.inputs, self.subcommand = checks, command, inputs, subcommand
        self.what = f"{subcommand.name}, {output}"
        self.folder = tempfile.mkdtemp()
        self.work = os.path.join(self.folder, "work")
        self.path = os.path.join(self.work, output)

    def attempt(self, prepare, status):
        """The run's error messages, and whether anything unfinished is left."""
        shutil.rmtree(self.work, ignore_errors=True)
        shutil.copytree(self.inputs, self.work)
        prepare()
        result = run(self.command, *self.subcommand.in_folder(self.work))
        self.checks.that(result.returncode == status, f"{self.what}: status {result.returncode}: {result.stderr}")
        left = [name for name in os.listdir(self.work) if name.startswith(".")]
        self.checks.that(left == [], f"{self.what}: left {left}")
        return result.stderr

    def check_links(self):
        """Links are kept, and what they lead to is written, whether it is there yet or not."""
        target = os.path.join(self.folder, "target")

        def link():
            os.symlink(target, self.path)

        for old in (True, False):
            if old:
                with open(target, "wb") as file:
                    file.write(OLD)
                os.chmod(target, 0o640)
            self.attempt(link, 0)
            self.checks.that(os.path.islink(self.path), f"{self.what}: the link is gone")
            self.checks.that(os.path.isfile(target) and bool(content(self.path)), f"{self.what}: not behind the link")
            if old:
                mode = stat.S_IMODE(os.stat(target).st_mode)
                self.checks.that(mode == 0o640, f"{self.what}: permissions {mode:o}")
            os.remove(target)

    def check_refusals(self):
        """What is no file is left alone, and the message names it."""
        null = os.stat("/dev/null")
        for prepare, part in ((lambda: os.symlink("/dev/null", self.path), "a device"),
                              (lambda: os.mkfifo(self.path), "a pipe"), (lambda: os.mkdir(self.path), "a folder"),
                              (lambda: os.symlink(self.path, self.path), "symbolic links")):
            message = self.attempt(prepare, 3)
            self.checks.that(self.path in message and part in message, f"{self.what}: the message is {message!r}")
            self.checks.that(os.path.lexists(self.path) and not os.path.isfile(self.path), f"{self.what}: replaced")
        now = os.stat("/dev/null")
        self.checks.that((null.st_ino, null.st_rdev) == (now.st_ino, now.st_rdev), f"{self.what}: replaced the device")


def check_signal(checks, command, data, number):
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(
            [command, "replay", os.path.join(data, "ubiquitin.trr"), "--cutoff", "2", "--verify", "all", "--out", "lists.h5",
             "--report", "report.json", "--plot", "report.html"],
            cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while len(os.listdir(folder)) < 3 and time.monotonic() < deadline:
            time.sleep(0.01)
        checks.that(len(os.listdir(folder)) == 3, "three unfinished files while it runs")
        process.send_signal(number)
        status = process.wait(timeout=300)
        checks.that(status != 0, f"{number!r}: status {status}")
        checks.that(os.listdir(folder) == [], f"{number!r}: left {os.listdir(folder)}")


def main(command, data):
    checks = Checks()
    with tempfile.TemporaryDirectory() as inputs:
        write_inputs(command, data, inputs)
        for subcommand in SUBCOMMANDS:
            for output in subcommand.outputs:
                places = Places(checks, command, inputs, subcommand, output)
                places.check_links()
                places.check_refusals()
                shutil.rmtree(places.folder)
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
        check_signal(checks, command, data, number)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])

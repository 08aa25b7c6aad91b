# SPDX-License-Identifier: MIT
"""The progress bar appears on a terminal only; a signal ends a run at once, wherever it is, and leaves no file.

    terminal.py DCH FOLDER_OF_TRAJECTORIES
"""

import os
import pty
import random
import signal
import subprocess
import sys
import tempfile
import time

from dch_command import Checks, run


def standard_error_on_a_terminal(arguments):
    controller, terminal = pty.openpty()
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=terminal)
    os.close(terminal)
    text = b""
    while True:
        try:
            part = os.read(controller, 4096)
        except OSError:  # Linux's end of file on a terminal whose other end is closed
            break
        if not part:
            break
        text += part
    os.close(controller)
    return process.wait(), text.decode()


def check_bar(checks, command, data):
    arguments = ["replay", os.path.join(data, "polymer.lammpstrj"), "--cutoff", "15", "--verify", "all"]
    status, text = standard_error_on_a_terminal([command, *arguments])
    checks.that(status == 0, f"status {status} on a terminal: {text}")
    checks.that("replaying [#" in text and "/42" in text and "ms/frame" in text, f"the bar: {text!r}")
    checks.that(text.endswith("\r\x1b[K"), "the bar is wiped at the end")
    status, text = standard_error_on_a_terminal([command, *arguments, "--quiet"])
    checks.that((status, text) == (0, ""), f"--quiet on a terminal: {text!r}")
    checks.that(run(command, *arguments).stderr == "", "no bar where standard error is no terminal")


def check_interrupt(checks, command, data, number):
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(
            [command, "replay", os.path.join(data, "ubiquitin.trr"), "--cutoff", "2", "--verify", "all", "--out", "lists.h5",
             "--report", "report.json", "--plot", "report.html"],
            cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while len(os.listdir(folder)) < 3 and time.monotonic() < deadline:
            time.sleep(0.01)
        checks.that(len(os.listdir(folder)) == 3, "three temporary files while it runs")
        process.send_signal(number)
        stdout, stderr = process.communicate(timeout=300)
        checks.that(process.returncode == 128 + number, f"{number!r}: status {process.returncode}: {stderr}")
        checks.that("interrupted" in stderr and stdout == "", f"{number!r}: {stdout} {stderr}")
        checks.that(os.listdir(folder) == [], f"{number!r}: left {os.listdir(folder)}")


LONGEST_WAIT = 2.0  # seconds; it takes milliseconds, but on a loaded machine a process may have to wait for its turn


def check_at_once(checks, command, folder, number, arguments, files, delay):
    """Sent a while after its temporary files are there, a signal ends the run long before its work would."""
    what = f"{number!r} in dchmd {' '.join(arguments)}"
    with tempfile.TemporaryDirectory(dir=folder) as work:
        process = subprocess.Popen([command, *arguments], cwd=work, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while len(os.listdir(work)) < files and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.002)
        time.sleep(delay)
        checks.that(len(os.listdir(work)) == files and process.poll() is None, f"{what}: it runs, with {files} files")
        start = time.monotonic()
        process.send_signal(number)
        _, stderr = process.communicate(timeout=300)
        waited = time.monotonic() - start
        checks.that(waited < LONGEST_WAIT, f"{what}: ended after {waited} s")
        checks.that(process.returncode == 128 + number, f"{what}: status {process.returncode}")
        checks.that(stderr == "dchmd: interrupted; unfinished output files are removed\n", f"{what}: {stderr}")
        checks.that(os.listdir(work) == [], f"{what}: left {os.listdir(work)}")


def write_gas(path, atoms, boundary):
    """One frame that takes all pairs half a minute."""
    number = random.Random(5)
    with open(path, "w") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{atoms}\nITEM: BOX BOUNDS {boundary}\n" + "0 100\n" * 3
                   + "ITEM: ATOMS id mol x y z\n")
        file.writelines("%d %d %.3f %.3f %.3f\n" % (atom, (atom + 1) // 2, *(number.uniform(0, 100) for _ in range(3)))
                        for atom in range(1, atoms + 1))


def check_long_loops(checks, command, data, folder):
    """Inside a frame, and in the subcommands that make files."""
    gas, frames = os.path.join(folder, "gas.lammpstrj"), os.path.join(folder, "frames.lammpstrj")
    open_gas = os.path.join(folder, "open.lammpstrj")  # so that bonds may be as long as they like
    write_gas(gas, 100000, "pp pp pp")
    write_gas(open_gas, 100000, "ff ff ff")
    with open(os.path.join(data, "polymer.lammpstrj")) as one, open(frames, "w") as many:
        many.write(one.read() * 30)
    outputs = ["--out", "lists.h5", "--report", "report.json", "--plot", "report.html"]
    replay = ["replay", gas, "--cutoff", "1", *outputs]
    for number, arguments, files, delay in (
            (signal.SIGTERM, [*replay, "--verify", "all"], 3, 1.5), (signal.SIGHUP, [*replay, "--engine", "allpairs"], 3, 1),
            (signal.SIGINT, ["contacts", open_gas, "--gap", "9", "--skip-bonds", "0", "--threads", "2", *outputs], 3, 1.5),
            (signal.SIGINT, ["convert", frames, "out.h5"], 1, 0), (signal.SIGHUP, ["convert", frames, "out.lammpstrj"], 1, 0),
            (signal.SIGTERM, ["generate", "melt", "--chains", "20000", "--beads", "1000", "melt.data"], 1, 0.1)):
        check_at_once(checks, command, folder, number, arguments, files, delay)


def check_ignored(checks, command, data):
    """A signal that the process was started to ignore, as by nohup, stays ignored."""
    previous = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    process = subprocess.Popen([command, "replay", os.path.join(data, "polymer.lammpstrj"), "--cutoff", "15", "--verify", "all"],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    signal.signal(signal.SIGHUP, previous)
    time.sleep(0.3)
    process.send_signal(signal.SIGHUP)
    stdout, stderr = process.communicate(timeout=300)
    checks.that(process.returncode == 0 and stderr == "" and "mismatches      0" in stdout, f"nohup: {stderr}")


def main(command, data):
    checks = Checks()
    check_bar(checks, command, data)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        check_interrupt(checks, command, data, number)
    with tempfile.TemporaryDirectory() as folder:
        check_long_loops(checks, command, data, folder)
    check_ignored(checks, command, data)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])

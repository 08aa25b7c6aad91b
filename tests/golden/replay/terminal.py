# SPDX-License-Identifier: MIT
"""The progress bar appears on a terminal only; an interrupted run leaves no file and ends in status 130.

    terminal.py DCH FOLDER_OF_TRAJECTORIES
"""

import os
import pty
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
        checks.that(process.returncode == 130, f"{number!r}: status {process.returncode}: {stderr}")
        checks.that("interrupted" in stderr and stdout == "", f"{number!r}: {stdout} {stderr}")
        checks.that(os.listdir(folder) == [], f"{number!r}: left {os.listdir(folder)}")


def main(command, data):
    checks = Checks()
    check_bar(checks, command, data)
    for number in (signal.SIGINT, signal.SIGTERM):
        check_interrupt(checks, command, data, number)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])

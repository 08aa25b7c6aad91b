# SPDX-License-Identifier: MIT
"""Other programs that keep the processors busy while a test runs."""

import contextlib
import subprocess
import sys


@contextlib.contextmanager
def load(programs):
    """So many other programs use the processors meanwhile; they end by themselves if this one cannot end them."""
    code = "import time\nend = time.monotonic() + 60\nwhile time.monotonic() < end: pass"
    running = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(programs)]
    try:
        yield
    finally:
        for program in running:
            program.kill()
            program.wait()

# SPDX-License-Identifier: MIT
"""The manual page of dchmd is what the command says of itself today, and groff reads it and that of lmp-dch without a warning.

    man.py DCHMD SOURCE
"""
import pathlib
import subprocess
import sys


def main(command, source):
    folder = pathlib.Path(source) / "replay" / "man"
    made = subprocess.run([sys.executable, folder / "make_man.py", command], check=True, capture_output=True, text=True).stdout
    if made != (folder / "dchmd.1").read_text():
        sys.exit("replay/man/dchmd.1 is not what the command says: replay/man/make_man.py DCHMD > replay/man/dchmd.1")
    for page in (folder / "dchmd.1", pathlib.Path(source) / "lammps_pair_style" / "man" / "lmp-dch.1"):
        read = subprocess.run(["groff", "-man", "-ww", "-Tutf8", "-z", page], capture_output=True, text=True)
        if read.returncode != 0 or read.stderr:
            sys.exit(f"groff: {read.stderr}")
    print(f"{len(made.splitlines())} lines")


main(*sys.argv[1:])

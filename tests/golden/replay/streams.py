# SPDX-License-Identifier: MIT
"""Standard output, standard error and standard input that are full, closed, pipes or files.

    streams.py DCH FOLDER_OF_TRAJECTORIES
"""

import gzip
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading

import h5py

from dch_command import Checks, run


def shell(command, line, *arguments, **variables):
    """A line of bash in which $0 is the command and $1, ... are the arguments. SIGPIPE is as a shell has it."""
    return subprocess.run(["bash", "-c", line, command, *arguments], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **variables})


def check_unwritable_messages(checks, command, data):
    """A standard error that is closed, full or that nobody reads takes away the messages and nothing else."""
    water, missing = os.path.join(data, "water.trr"), os.path.join(data, "missing.trr")
    for where in ("2>&-", "2>/dev/full", "2> >(exec true)"):
        for line, status in ((f'"$0" info "$2" {where}', 3), (f'"$0" replay "$1" --cutoff 99 {where}', 2),
                             (f'"$0" {where}', 2), (f'"$0" foo {where}', 2), (f'"$0" info "$1" {where}', 0)):
            result = shell(command, line, water, missing)
            checks.that(result.returncode == status, f"{line}: status {result.returncode}, not {status}")
            checks.that((result.stdout != "") == (status == 0), f"{line}: {result.stdout}")


def check_files_beside_closed_streams(checks, command, data):
    """No file gets the number of a closed stream, and its messages."""
    polymer = os.path.join(data, "polymer.lammpstrj")
    options = "--cutoff 8 --out lists.h5 --report report.json --plot report.html"
    with tempfile.TemporaryDirectory() as folder:
        for streams, status in (("2>&-", 0), ("<&- 2>&-", 0), ("<&- >&- 2>&-", 3)):
            result = shell(command, f'cd "$2" && "$0" replay "$1" {options} {streams}', polymer, folder)
            checks.that(result.returncode == status, f"{streams}: status {result.returncode}")
            with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
                checks.that(json.load(file)["frames"] == 42, f"{streams}: the report")
            with h5py.File(os.path.join(folder, "lists.h5")) as file:
                checks.that(len(file["frame"]) == 42, f"{streams}: the lists")
            for line in ('"$0" convert "$1" out.h5 --quiet', '"$0" replay out.h5 --cutoff 8 --quiet'):  # with child processes
                result = shell(command, f'cd "$2" && {line} {streams}', polymer, folder)
                checks.that(result.returncode == 0, f"{line} {streams}: status {result.returncode}")


def check_unwritable_results(checks, command, data):
    """Results that cannot be printed are an error, for each subcommand; where their reader has gone, a quiet one."""
    polymer = os.path.join(data, "polymer.lammpstrj")
    with tempfile.TemporaryDirectory() as folder:
        for arguments in ('info "$1"', 'info "$1" --json', 'replay "$1" --cutoff 8', "--help", "--version", "help info",
                          'convert "$1" o.h5', "generate melt --chains 9 --beads 9 m.data"):
            for where, reason in ((">/dev/full", "No space left on device"), (">&-", "Bad file descriptor")):
                result = shell(command, f'cd "$2" && "$0" {arguments} {where}', polymer, folder)
                checks.that(result.returncode == 3, f"{arguments} {where}: status {result.returncode}")
                checks.that(f"dchmd: standard output: cannot be written: {reason}" in result.stderr,
                            f"{arguments} {where}: {result.stderr}")
            # the pipe has no reader before the command starts to write
            result = shell(command, f'cd "$2" && {{ sleep 0.2; "$0" {arguments}; echo $? >&2; }} | true', polymer, folder)
            checks.that(result.stderr == f"{128 + signal.SIGPIPE}\n", f"{arguments} | true: {result.stderr}")
            result = shell(command, f'cd "$2" && "$0" {arguments} | head -1 > /dev/null', polymer, folder)
            checks.that(result.stderr == "", f"{arguments} | head -1: {result.stderr}")
        result = shell(command, 'cd "$2" && "$0" replay "$1" --cutoff 8 --quiet --report r.json >/dev/full', polymer, folder)
        checks.that(result.returncode == 0, f"nothing to print: {result.stderr}")


def write_to(path, content):
    """Writes into a named pipe beside this thread."""
    def write():
        with open(path, "wb") as file:
            file.write(content)
    thread = threading.Thread(target=write)
    thread.start()
    return thread


def check_standard_input(checks, command, data):
    """A pipe, packed or not, and a file on standard input say what the file itself does."""
    for name, frmt in (("polymer.lammpstrj", "lammpstrj"), ("nacl.lammpstrj", "dump"), ("nopbc.dcd", "dcd"),
                       ("cell_shapes.xtc", "xtc"), ("water.trr", "trr")):
        check_pipes_of(checks, command, os.path.join(data, name), frmt)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "three.gro")
        with open(path, "w", encoding="utf-8") as file:
            file.write("three atoms\n3\n" + "".join(f"    1SOL     OW{i:5d}{i:8.3f}{i:8.3f}{i:8.3f}\n" for i in (1, 2, 3)) +
                       "   5.00000   5.00000   5.00000\n")
        check_pipes_of(checks, command, path, "gro")


def check_pipes_of(checks, command, path, frmt):
    is_packable = frmt in ("lammpstrj", "dump")
    with open(path, "rb") as file:
        content = file.read()
    expected = json.loads(run(command, "info", "--json", path).stdout)
    lines = ['cat "$1" | "$0" info --json - --format ' + frmt, '"$0" info --json - --format ' + frmt + ' < "$1"',
             '"$0" info --json --format ' + frmt + ' <(cat "$1")']
    if is_packable:
        lines.append('gzip -c "$1" | "$0" info --json - --format ' + frmt)
    for line in lines:
        result = shell(command, line, path)
        found = json.loads(result.stdout or "{}")
        if "<(" not in line:
            checks.that(found.get("file") == "standard input", f"{line}: named {found.get('file')}")
        checks.that({**found, "file": path} == expected, f"{line}: {result.stderr} {found}")
    with tempfile.TemporaryDirectory() as folder:
        for pipe, packed in (("pipe." + frmt, content), ("PIPE.DUMP.gz", gzip.compress(content))):
            if not is_packable and packed is not content:
                continue
            pipe = os.path.join(folder, pipe)
            os.mkfifo(pipe)
            writer = write_to(pipe, packed)
            result = run(command, "info", "--json", pipe)
            writer.join()
            checks.that({**json.loads(result.stdout or "{}"), "file": path} == expected, f"{pipe}: {result.stderr}")


def check_replay_from_pipe(checks, command, data):
    """The same lists from a pipe, whatever the number of threads."""
    path, hashes = os.path.join(data, "polymer.lammpstrj"), set()
    with tempfile.TemporaryDirectory() as folder:
        for line in ('"$0" replay "$1" --cutoff 9 --skin 1', 'cat "$1" | "$0" replay - --format lammpstrj --cutoff 9 --skin 1',
                     '"$0" replay "$1" --cutoff 9 --skin 1 --threads 3', '"$0" replay "$1" --cutoff 9 --skin 1 --threads 8'):
            report = os.path.join(folder, "report.json")
            result = shell(command, line + ' --report "$2"', path, report)
            checks.that(result.returncode == 0, f"{line}: {result.stderr}")
            with open(report, encoding="utf-8") as file:
                content = json.load(file)
            hashes.add(content["list_hash"])
            threads = int(line.split("--threads ")[1]) if "--threads" in line else 1
            checks.that(content["threads"] == threads, f"{line}: threads {content['threads']}")
    checks.that(len(hashes) == 1, f"lists differ: {hashes}")


def check_bad_input(checks, command, data):
    polymer = os.path.join(data, "polymer.lammpstrj")
    for line, status, parts in (
            ('head -c 3000 "$1" | "$0" info - --format lammpstrj', 3, ["standard input: frame 0, line", "truncated"]),
            ('"$0" info - --format dump < /dev/null', 3, ["standard input"]), ('"$0" info - --format dump <&-', 3, ["standard input"]),
            ('cat "$1" | "$0" info - --format dcd', 3, ["standard input", "DCD"]),
            ('cat "$1" | "$0" info - --format h5', 2, ["standard input", "H5MD", "save it to a file"]),
            ('cat "$1" | "$0" info -', 2, ["standard input", "--format"])):
        result = shell(command, line, polymer)
        checks.that(result.returncode == status, f"{line}: status {result.returncode}")
        checks.that(all(part in result.stderr for part in parts) and "/proc" not in result.stderr, f"{line}: {result.stderr}")
    with tempfile.TemporaryDirectory() as folder:
        shell(command, 'cat "$1" | "$0" info - --format dump', polymer, TMPDIR=folder)
        checks.that(os.listdir(folder) == [], "the copy of standard input has gone")
    result = subprocess.run([command, "info", "-", "--format", "dump"], input=open(polymer, "rb").read(), capture_output=True,
                            preexec_fn=limit_file_size, restore_signals=True, check=False)
    checks.that(result.returncode == 3 and b"File too large" in result.stderr, f"a copy too large: {result}")


def limit_file_size():
    import resource

    resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))


def main(command, data):
    checks = Checks()
    check_unwritable_messages(checks, command, data)
    check_files_beside_closed_streams(checks, command, data)
    check_unwritable_results(checks, command, data)
    check_standard_input(checks, command, data)
    check_replay_from_pipe(checks, command, data)
    check_bad_input(checks, command, data)
    checks.finish()


if __name__ == "__main__":
    main(*sys.argv[1:])

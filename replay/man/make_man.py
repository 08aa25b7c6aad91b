#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the manual page of dchmd, from what the command itself says of its subcommands and options.

    make_man.py DCHMD > replay/man/dchmd.1
"""
import re
import subprocess
import sys

HEAD = """.\\" SPDX-License-Identifier: MIT
.\\" Made by replay/man/make_man.py.
.TH DCHMD 1 "" "dch {version}" "User commands"
.SH NAME
dchmd \\- neighbor lists, contacts and crossings of molecular dynamics trajectories
.SH SYNOPSIS
.B dchmd
.I SUBCOMMAND
.RI [ OPTIONS ]
.RI [ FILE ]
.br
.B dchmd help
.I SUBCOMMAND
.SH DESCRIPTION
dchmd reads trajectories of molecular dynamics, makes the neighbor list of every frame by a discrete center hierarchy that
it keeps up from frame to frame, and compares the lists with all pairs if asked to. It also follows contacts of polymer
chains, finds bonds that pass through each other, answers queries of proximity and runs hard spheres."""
COLUMN = 26  # where the help has the texts of options


def says(command, *arguments):
    return subprocess.run([command, *arguments], check=True, capture_output=True, text=True).stdout


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def entries(lines):
    """Names and texts of a list of options; what has no name goes on with the text before it."""
    found = []
    for line in lines:
        name, text = line[:COLUMN].strip(), line[COLUMN:].strip()
        if name:
            found.append([name, text])
        else:
            found[-1][1] += " " + text
    return found


def sections(text):
    """Heads like "Options:" with their lines; the first one is empty."""
    head, lines = "", []
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][a-z ]+:", line):
            yield head, lines
            head, lines = line, []
        elif line.strip():
            lines.append(line)
    yield head, lines


def subcommands(command, *path):
    for head, lines in sections(says(command, *path, "--help")):
        if head == "Subcommands:":
            for name, _ in entries(lines):
                yield (*path, name)
                if name != "help":
                    yield from subcommands(command, *path, name)


def print_options(lines):
    for name, text in entries(lines):
        print(f".TP\n.B {escaped(name)}\n{escaped(text)}")


def print_subcommand(command, path):
    print(f".SS {escaped(' '.join(path))}")
    for head, lines in sections(says(command, *path, "--help")):
        if not head:
            print("\n".join(escaped(line) for line in lines if not line.startswith("Usage:")))
        elif head != "Subcommands:":
            print_options(lines)


def main(command):
    help_text = says(command, "--help")
    parts = dict(sections(help_text))
    print(HEAD.format(version=says(command, "--version").split()[-1]))
    print(".SH OPTIONS")
    print_options(parts["Options:"])
    print(".SH SUBCOMMANDS")
    for path in subcommands(command):
        print_subcommand(command, path)
    status = re.search(r"^Exit status: (.*?)\n(?=Usage:)", help_text, re.MULTILINE | re.DOTALL)[1]
    print(f".SH EXIT STATUS\n{escaped(status)}")
    print(".SH EXAMPLES")
    for line in parts["First steps:"]:
        if line.startswith("  "):
            example, text = re.split(r"   +", line.strip())
            print(f".TP\n.B {escaped(example)}\n{escaped(text)}")


main(sys.argv[1])

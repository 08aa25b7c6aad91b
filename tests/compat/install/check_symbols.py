# SPDX-License-Identifier: MIT
"""What libdch shows: its SONAME is the library's name with the first two numbers of the version, and every symbol of the
project that it exports is named in an installed header.

    check_symbols.py LIBRARY INCLUDE     a shared library, and the folder of its headers
"""
import pathlib
import re
import subprocess
import sys

# A function or a variable: namespaces of the project, then a name that a header has to have.
NAME = re.compile(r"^(?:.*? )?dch::(?:(?:necklace|kinetic|zonotope|detail)::)*(~?\w+)(?:::(\w+))?")


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def hidden_from(words, symbols):
    """The symbols of which a name is in no header, or that are of an Impl."""
    for symbol in symbols:
        match = NAME.match(re.sub(r"^(vtable|typeinfo|typeinfo name|VTT|guard variable) for ", "", symbol))
        if match and ("::Impl::" in symbol or not {name for name in match.groups() if name} <= words):
            yield symbol


def main(library, include):
    library = pathlib.Path(library).resolve()
    soname = re.search(r"Library soname: \[(.*)\]", output("readelf", "-d", library))[1]
    words = set(re.findall(r"\w+", " ".join(p.read_text() for p in pathlib.Path(include).rglob("*.hpp"))))
    lines = output("nm", "-DC", "--defined-only", library).splitlines()
    symbols = [line.split(" ", 2)[2] for line in lines if "{lambda" not in line]  # lambdas have no names
    shown = sorted(hidden_from(words, symbols))
    print(f"{library.name}: {soname}, {len(symbols)} symbols, {len(shown)} of them in no header")
    print("\n".join(shown))
    if not any("dch::make_dch_search" in symbol for symbol in symbols):
        sys.exit("make_dch_search is not among them")
    if not re.fullmatch(re.escape(soname) + r"\.\d+", library.name) or not re.fullmatch(r"libdch\.so\.\d+\.\d+", soname):
        sys.exit(f"the SONAME {soname} does not fit {library.name}")
    sys.exit(1 if shown else 0)


main(*sys.argv[1:])

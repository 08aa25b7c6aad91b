# SPDX-License-Identifier: MIT
"""What a run was made on: processor, compiler, commit, versions of hosts."""

import os
import platform
import re
import shutil
import subprocess
import sys
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
UNKNOWN = "unknown"
# Of the library, each wider than the one before, and the flags of a processor that it looks for.
INSTRUCTION_SETS = {"portable": "", "sse4.2": "sse4_2 popcnt", "avx2": "avx2 fma bmi2",
                    "avx512": "avx512f avx512bw avx512vl avx512dq avx512_vbmi2"}


def output_of(*command):
    """Standard output of a program, or "" if there is no such program or it fails."""
    if shutil.which(command[0]) is None:
        return ""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True, check=False, cwd=ROOT)
    return done.stdout if done.returncode == 0 else ""


def first_match(pattern, text):
    found = re.search(pattern, text, re.MULTILINE)
    return found.group(1).strip() if found else UNKNOWN


def cpu(facts=None):
    """The name of the processor, as /proc/cpuinfo or the text `facts` has it, with the generation where that leaves it out."""
    if facts is None:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            facts = file.read()
    name = first_match(r"^model name\s*:\s*(.*)$", facts)
    # Hypervisors often call each EPYC by this name alone.
    return f"{name}, {zen(facts)}" if name == "AMD EPYC" else name


def zen(facts):
    """Generation of an AMD processor: of family 25, models below 16 and from 32 to 95 are Zen 3 and all others Zen 4."""
    family, model = (first_match(rf"^{what}\s*:\s*(\d+)$", facts) for what in ("cpu family", "model"))
    if family == "25":
        return "Zen 3" if int(model) < 16 or 32 <= int(model) < 96 else "Zen 4"
    return {"23": "Zen 1 or 2", "26": "Zen 5"}.get(family, f"family {family}")


def instruction_sets():
    """Those that this processor has."""
    if platform.machine() == "aarch64":
        return ["portable", "neon"]
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = set(first_match(r"^flags\s*:\s*(.*)$", file.read()).split())
    return [name for name, needed in INSTRUCTION_SETS.items() if set(needed.split()) <= flags]


def instruction_set():
    """What the library chooses: the widest set, or what is forced."""
    return os.environ.get("DCH_FORCE_ISA", instruction_sets()[-1])


def processors_in_use(seconds=0.5):
    """How many processors are kept busy while this program sleeps. (A load average would have the last benchmark in it.)"""

    def busy_ticks():
        with open("/proc/stat", encoding="utf-8") as file:
            user, nice, system, _, _, *rest = map(int, file.readline().split()[1:9])
        return user + nice + system + sum(rest)

    before = busy_ticks()
    time.sleep(seconds)
    return (busy_ticks() - before) / (seconds * os.sysconf("SC_CLK_TCK"))


def is_busy(load):
    """Whether others take so much of the machine that times scatter."""
    return load > 0.5


def machine():
    return {"cpu": cpu(), "processors": os.cpu_count(), "instruction_set": instruction_set(),
            "system": f"{platform.system()} {platform.release()}", "load_before": processors_in_use()}


def build_facts(build):
    """Compiler and flags of a folder of a build, from CMake's cache."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        cache = file.read()
    compiler = first_match(r"^CMAKE_CXX_COMPILER:[A-Z]*=(.*)$", cache)
    kind = first_match(r"^CMAKE_BUILD_TYPE:[A-Z]*=(.*)$", cache)
    flags = first_match(rf"^CMAKE_CXX_FLAGS_{kind.upper()}:[A-Z]*=(.*)$", cache)
    return {"compiler": output_of(compiler, "--version").split("\n")[0] or compiler, "type": kind, "flags": flags}


def source_facts():
    commit = output_of("git", "rev-parse", "HEAD").strip() or UNKNOWN
    return {"commit": commit, "changed": bool(output_of("git", "status", "--porcelain", "--untracked-files=no").strip())}


def python_version_of(module, expression):
    return output_of("/usr/bin/python3", "-c", f"import {module}; print({expression})").strip() or UNKNOWN


def lammps():
    return first_match(r"Massively Parallel Simulator - (.*)$", output_of("lmp", "-h"))


def gromacs():
    return first_match(r"^GROMACS version:\s*(.*)$", output_of("gmx", "--version"))


def nanoflann():
    """Of the header, which has it as 0xMmp."""
    try:
        with open("/usr/include/nanoflann.hpp", encoding="utf-8") as file:
            digits = first_match(r"#define NANOFLANN_VERSION 0x([0-9a-fA-F]{3})", file.read())
    except FileNotFoundError:
        return UNKNOWN
    return ".".join(digits) if digits != UNKNOWN else UNKNOWN


HOSTS = {
    "LAMMPS": lammps,
    "GROMACS": gromacs,
    "OpenMM": lambda: python_version_of("openmm", "openmm.Platform.getOpenMMVersion()"),
    "SciPy": lambda: python_version_of("scipy", "scipy.__version__"),
    "nanoflann": nanoflann,
    "Python": lambda: sys.version.split()[0],
}


def versions(hosts):
    return {host: HOSTS[host]() for host in hosts}

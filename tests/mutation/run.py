# SPDX-License-Identifier: MIT
"""Mutation testing of the library: whether the tests notice when an operator, a bound, a margin, a clause or a
statement of what keeps the lists right is changed. All mutants of a file are compiled at once (mutate.py) and linked
with the tests' objects of a build; then the tests run once for each, stopping at the first that fails, the quick ones
first.

survivors.toml says of each mutant that no test can notice why that is so. The run fails if another one survives, or if
one of these is killed or there no more."""
import argparse
import concurrent.futures
import fnmatch
import json
import math
import os
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import threading
import time
import tomllib

import mutate

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SOURCES = ROOT / "lib" / "src"
# What is reported of memory, and what only fetches ahead.
SKIPPED_FUNCTIONS = {"memory_bytes", "ask_for"}
# What is only measured and counted, which tests of the counts alone see, and what only saves time.
SKIPPED_LINES = r"seconds|stats\.distances|stats\.visited|\btested\b|\bClock\b|counting|__builtin_prefetch|\bask_for\b"

# What is run for a file: objects of test programs, and which of their tests, stage by stage.
HIERARCHY = (["unit/core/dch_unit_core", "unit/hierarchy/dch_unit_hierarchy", "property/dch_property_hierarchy"],
             ["*Certificate*:Repair.*:Maintenance*:Update.*:Singletons.*:Insertion.*:Removal.*:PackingOf*:"
              "*RepairOfSmallScenes*",
              "Work.*:Visits.*:KeptBalls.*:HierarchyTest.*:HierarchyStats.*:Validate*:AutomaticPolicy*:*/Packing.Edges*:"
              "*/Packing.TheCheck*/D1",
              "HierarchyMotion.NoMotion*:HierarchyMotion.Boxes*:HierarchyChurn.*:HierarchySparse*:"
              "*/HierarchySparse.*/none",
              "*/HierarchyChurn.*/orthorhombic_ppf:*/HierarchyMotion.*/orthorhombic_ppf:*/ListSizes.UnderMotion/none",
              "*/EngineMemory.*"])
STALE_TEST = (["unit/core/dch_unit_core", "property/dch_property_expiry"], ["*StaleTest*:*VerletList*", "*AffineMotion*"])
LIST_KERNELS = (["unit/core/dch_unit_core"], ["*ListKernelsTest*"])
PAIR_FILTER = (["unit/core/dch_unit_core"], ["PairFilter.*", "*CellSearch.*/orthorhombic*"])
ORDERED_ROWS = (["unit/core/dch_unit_core"], ["*OrderedRows*:RowParts.*:StartRows.*"])
LATTICE = (["unit/core/dch_unit_core"], ["Lattice.*"])
LIST_LIMITS = (["unit/core/dch_unit_core", "property/dch_property_hierarchy"],
               ["ListLimits.*", "RandomScenes.*:*ListsEqualTheOracleInTheSmallestBox*"])
LEAVES = (["unit/core/dch_unit_core", "unit/hierarchy/dch_unit_hierarchy", "property/dch_property_hierarchy"],
          ["MeasuredLeaves*:LabelledLeaves*", "RandomScenes.*:*ListsEqualTheOracleInTheSmallestBox*", "*/EngineMemory.*"])
CLUSTER_PAIRS = (["unit/hierarchy/dch_unit_hierarchy", "property/dch_property_clusters"],
                 ["ClusterPairFinder.*:Work.OfClusterPairs*",
                  "ClusterPairsTest.*:ClusterPairsEdges.*:*ClusterPairsScenes.LeaveOut*/orthorhombic_ppf:"
                  "*TasksName*/orthorhombic_ppf",
                  "*ClusterPairsScenes.*/orthorhombic_ppf:*ClusterPairsScenes.*/none:*ForcesOnThreads.*/none",
                  "*ClusterPairsScenes.*/triclinic_ppp"])
ENTRY_ORDER = (["property/dch_property_clusters"],
               ["*OrderedEntries.*/orthorhombic_ppf:*OrderedEntries.*/none", "*OrderedEntries.*:*OrderedForces.*"])
LEAF_FRAME = (["unit/core/dch_unit_core"], ["LeafFrame.*"])
CLUSTER_KERNELS = (["unit/core/dch_unit_core"], ["*ClusterSearchKernelsTest*"])
FILES = {
    "hierarchy/motion/refresh.cpp": HIERARCHY,
    "hierarchy/motion/repair.cpp": HIERARCHY,
    "hierarchy/points/insert_remove.cpp": HIERARCHY,
    "hierarchy/points/links.cpp": HIERARCHY,
    "hierarchy/points/removal.cpp": HIERARCHY,
    "hierarchy/points/singletons.cpp": HIERARCHY,
    "lists/stale_test.cpp": STALE_TEST,
    "geometry/affine_motion.cpp": STALE_TEST,
    "simd/list_kernels_loops.hpp": LIST_KERNELS,
    "simd/list_rows_loops.hpp": LIST_KERNELS,
    "lists/pair_filter.cpp": PAIR_FILTER,
    "lists/ordered_rows.cpp": ORDERED_ROWS,
    "geometry/lattice.cpp": LATTICE,
    "lists/list_limits.cpp": LIST_LIMITS,
    "hierarchy/measured_leaves.cpp": LEAVES,
    "leaves/labelled_leaves.cpp": LEAVES,
    "leaves/quantized_leaves.cpp": LEAVES,
    "leaves/leaf_frame.cpp": LEAF_FRAME,
    "clusters/cluster_pair_finder.cpp": CLUSTER_PAIRS,
    "clusters/cluster_pair_cuts.cpp": CLUSTER_PAIRS,
    "clusters/cluster_pair_masks.cpp": CLUSTER_PAIRS,
    "clusters/cluster_pair_order.cpp": ENTRY_ORDER,
    "clusters/simd/join_loops.hpp": CLUSTER_KERNELS,
    "clusters/simd/near_loops.hpp": CLUSTER_KERNELS,
}
SLACK_SECONDS = 2
WALL_FACTOR = 20  # of a busy machine
MEMORY_BYTES = 4 << 30


def compile_commands(build):
    entries = json.loads((build / "compile_commands.json").read_text())
    return {entry["file"]: entry for entry in entries}


def objects_of(build, commands, programs):
    """What the build makes of the tests' sources, joined or one by one; objects of an earlier build may lie beside it."""
    found = []
    for program in programs:
        outputs = (re.search(rf" -o (\S*/{pathlib.Path(program).name}\.dir/\S+\.o) ", entry["command"])
                   for entry in commands.values())
        objects = sorted(build / output[1] for output in outputs if output)
        if not objects or not all(path.exists() for path in objects):
            sys.exit(f"{build} holds no objects of {program}: build {pathlib.Path(program).name} first")
        found += objects
    return found


def includes(path, name):
    return f'#include "{name}"' in path.read_text()


class Program:
    """The tests with the mutants of one source in them."""

    def __init__(self, file, build, scratch):
        self.file, self.build, self.scratch = file, build, scratch
        self.programs, self.stages = FILES[file]
        self.commands = compile_commands(build)
        self.path = scratch / (file.replace("/", "_") + ".tests")
        self.mutator = None
        self.seconds = {}  # by stage
        self.timing = threading.Lock()

    def make(self):
        """Leaves out what does not compile, line by line."""
        dropped = set()
        text = (SOURCES / self.file).read_text()
        for _ in range(8):
            self.mutator = mutate.mutants_of(text, SKIPPED_FUNCTIONS, SKIPPED_LINES, dropped)
            mutated = self.scratch / "src" / self.file
            mutated.parent.mkdir(parents=True, exist_ok=True)
            mutated.write_text(self.mutator.schemata())
            lines = set()
            objects = [self.compile(source, lines) for source in self.sources()]
            if not lines:
                self.link(objects)
                return
            dropped |= lines
        sys.exit(f"the mutants of {self.file} do not compile")

    def sources(self):
        """Those that are compiled anew: the file, or those that include it."""
        if self.file.endswith(".cpp"):
            return [SOURCES / self.file]
        folder = (SOURCES / self.file).parent
        headers = [self.file]  # and those beside it that include it
        for name in headers:
            headers += [str(p.relative_to(SOURCES)) for p in sorted(folder.glob("*.hpp")) if includes(p, name)]
        return [p for p in sorted(folder.glob("*.cpp"))
                if str(p) in self.commands and any(includes(p, name) for name in headers)]

    def compile(self, source, bad_lines):
        relative = source.relative_to(SOURCES)
        copy = self.scratch / "src" / relative
        if str(relative) != self.file:
            copy.write_text(source.read_text())
        entry = self.commands[str(source)]
        words = shlex.split(entry["command"])
        out = self.scratch / (str(relative).replace("/", "_") + ".o")
        words[words.index("-o") + 1] = str(out)
        words[words.index("-c") + 1] = str(copy)
        words = [w for w in words if w != "-Werror" and not w.startswith("-W")]
        words += ["-O1", "-g0"]  # compiled once for hundreds of short runs
        words[1:1] = ["-w", "-fmax-errors=0", "-D_GLIBCXX_ASSERTIONS", f"-I{HERE}", f"-I{self.scratch / 'src'}"]
        done = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True)
        if done.returncode == 0:
            return out
        named = {int(n) for n in re.findall(rf"{re.escape(pathlib.Path(self.file).name)}:(\d+)", done.stderr)}
        known = {m.line for m in self.mutator.source.mutants}
        if not named & known:
            sys.exit(f"{source}:\n{done.stderr[:4000]}")
        bad_lines |= named
        return out

    def link(self, objects):
        runtime = self.scratch / "mutants.o"
        compiler = shlex.split(next(iter(self.commands.values()))["command"])[0]
        if not runtime.exists():
            subprocess.run([compiler, "-O2", "-c", str(HERE / "mutants.cpp"), "-o", str(runtime)], check=True)
        subprocess.run([compiler, "-o", str(self.path), *map(str, objects_of(self.build, self.commands, self.programs)),
                        *map(str, objects), str(runtime), str(self.build / "forces" / "libdch_forces.a"),
                        str(self.build / "lib" / "libdch_core.a"),
                        "-lgtest_main", "-lgmock", "-lgtest", "-lpthread"], check=True)

    def run(self, number, stage, limit):
        """The exit status of a stage, which is not 0 if it took more processor time than `limit` [s]."""
        command = [str(self.path), f"--gtest_filter={self.stages[stage]}", "--gtest_brief=1", "--gtest_fail_fast"]
        try:
            done = subprocess.run(command, env={**os.environ, "DCH_MUTANT": str(number)}, timeout=WALL_FACTOR * limit,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.scratch,
                                  preexec_fn=lambda: limit_resources(math.ceil(limit)))
            return done.returncode
        except subprocess.TimeoutExpired:
            return None

    def limit_of(self, stage):
        """Of its processor time, by what it takes without a mutant; timed when it is first wanted."""
        with self.timing:
            if stage not in self.seconds:
                start = time.monotonic()
                if self.run(0, stage, 1200) != 0:
                    sys.exit(f"{self.file}: without a mutant at work {self.stages[stage]} fails")
                self.seconds[stage] = time.monotonic() - start
        return 5 * self.seconds[stage] + SLACK_SECONDS

    def verdict(self, mutant):
        """Which stage killed it, or None."""
        for stage in range(len(self.stages)):
            if self.run(mutant.number, stage, self.limit_of(stage)) != 0:
                return stage
        return None


def limit_resources(seconds):
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))


def known_survivors(file):
    """{name: reason}"""
    known = {}
    for entry in tomllib.loads((HERE / "survivors.toml").read_text()).get("survivors", []):
        if entry["file"] == file:
            for name in entry["mutants"]:
                known[name] = entry["reason"]
    return known


def test_file(file, build, scratch, options):
    program = Program(file, build, scratch)
    program.make()
    mutants = [m for m in program.mutator.source.mutants if fnmatch.fnmatch(m.name, options.mutant)]
    chosen = mutants[::options.sample]
    print(f"{file}: {len(mutants)} mutants, {len(chosen)} tried", flush=True)
    known = known_survivors(file)
    faults, killed, explained = [], [0] * len(program.stages), 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for mutant, stage in zip(chosen, pool.map(program.verdict, chosen)):
            if stage is not None:
                killed[stage] += 1
                if mutant.name in known:
                    faults.append(f"killed, but said to survive: {mutant.name}")
            elif mutant.name in known:
                explained += 1
            else:
                faults.append(f"survived, line {mutant.line}: {mutant.name}")
                print("  " + faults[-1], flush=True)
    gone = set(known) - {m.name for m in program.mutator.source.mutants}
    faults += [f"not there any more: {name}" for name in sorted(gone)]
    seconds = ", ".join(f"{s:.1f}" for s in program.seconds.values())
    print(f"{file}: {sum(killed)} killed (by stage: {killed}), {explained} survived and explained, "
          f"{len(faults)} faults; stages of {seconds} s", flush=True)
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "dev", help="where the tests are built")
    parser.add_argument("--file", action="append", choices=sorted(FILES), help="this one alone; may be repeated")
    parser.add_argument("--sample", type=int, default=1, metavar="K", help="every K-th mutant of each file")
    parser.add_argument("--mutant", default="*", help="those alone whose name matches")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="tests that run at a time")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for what is compiled, kept")
    options = parser.parse_args()
    faults = []
    with tempfile.TemporaryDirectory(prefix="dch-mutants-") as scratch:
        scratch = options.keep or scratch
        for file in options.file or FILES:
            faults += [f"{file}: {fault}" for fault in
                       test_file(file, options.build.resolve(), pathlib.Path(scratch), options)]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

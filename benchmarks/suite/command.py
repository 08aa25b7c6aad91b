# SPDX-License-Identifier: MIT
"""The command line of benchmarks/run."""

import argparse
import concurrent.futures
import os
import subprocess
import time

from . import families, html_report, machine, markdown_report, record
from .running import Failed, Missing, Suite, say

OK, FAILED, USAGE = 0, 1, 2
# The longest first.
TRAJECTORIES = {"quick": (["chain32k", "melt32k", "water30k", "melt4k"], ["--frames", "20"]),
                "full": (["melt1m", "melt256k", "chain32k", "melt32k", "water30k", "melt4k"], [])}


def arguments():
    parser = argparse.ArgumentParser(
        prog="benchmarks/run", description="Runs the benchmarks, each on one processor and each after its answers have been "
        "compared, and writes one JSON file for each and benchmarks/report.html; with --results also the kept records and "
        "docs/results.md.")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", dest="size", action="store_const", const="quick", default="full",
                      help="small sizes: ten minutes in all")
    size.add_argument("--tiny", dest="size", action="store_const", const="tiny",
                      help="sizes that only show that everything works")
    parser.add_argument("--only", action="append", metavar="NAME", choices=[f.NAME for f in families.ALL],
                        help="run only this: " + ", ".join(f.NAME for f in families.ALL) + "; may be repeated")
    parser.add_argument("--build", help="folder of a build; without this build/release is configured and built first")
    parser.add_argument("--trajectories", help="folder that make_trajectories filled; without this build/trajectories or, if "
                        "that is not there, build/trajectories-SIZE, which is filled first")
    parser.add_argument("--out", help="folder for records and the report (default: BUILD/benchmarks/results-SIZE for the records, "
                        "benchmarks/report.html)")
    parser.add_argument("--records", metavar="FOLDER", default=os.path.join(machine.ROOT, "benchmarks", "records"),
                        help="kept records, one file for each processor (default: benchmarks/records)")
    parser.add_argument("--results", metavar="FILE", nargs="?", const=os.path.join(machine.ROOT, "docs", "results.md"),
                        help="put this run's records into --records, and write this page (docs/results.md without FILE) from all "
                        "that are there")
    parser.add_argument("--processor", type=int, default=min(os.sched_getaffinity(0)),
                        help="processor to stay on (default: the first that this program may use)")
    parser.add_argument("--strict", action="store_true", help="a benchmark that lacks something it needs has failed")
    parser.add_argument("--report-only", action="store_true", help="run nothing; write the reports from the records there are")
    return parser


def build():
    """Configures and builds what the benchmarks need in the preset release."""
    say("building the preset release")
    for command in (["cmake", "--preset", "release"], ["cmake", "--build", "--preset", "release", "--target", "dch_benchmarks"]):
        if subprocess.run(command, cwd=machine.ROOT, stdout=subprocess.DEVNULL, check=False).returncode != 0:
            raise Failed(" ".join(command) + " failed")


def trajectories(options):
    """The folder of trajectories; those that are missing are made, by programs that may be missing."""
    if options.trajectories:
        return options.trajectories
    usual = os.path.join(machine.ROOT, "build", "trajectories")
    if options.size == "tiny" or os.path.isdir(usual):
        return usual
    folder = usual if options.size == "full" else f"{usual}-{options.size}"
    names, extra = TRAJECTORIES[options.size]
    program = [os.path.join(machine.ROOT, "benchmarks", "engine", "make_trajectories"), "--build", options.build, "--to", folder]

    def make(name):
        if subprocess.run([*program, *extra, name], stdout=subprocess.DEVNULL, check=False).returncode != 0:
            say(f"{name}: no trajectory; melts are shaken lattices then, and what needs it is left out")

    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as workers:
        list(workers.map(make, names))
    return folder


def run_family(family, options, out):
    """Writes the record of one family. Returns whether it passed; what is missing is no failure, but said."""
    suite = Suite(options.build, options.trajectories, options.size, options.processor)
    facts = {"machine": machine.machine(), "build": machine.build_facts(options.build), "source": machine.source_facts(),
             "hosts": machine.versions(family.HOSTS)}
    say(f"{family.NAME}: {family.TITLE}")
    try:
        result = family.run(suite)
    except Missing as error:
        say(f"{family.NAME}: left out: {error}")
        if options.strict:
            return False
        result = record.Result(left_out=[str(error).splitlines()[-1]])
    except Failed as error:
        say(f"{family.NAME}: failed: {error}")
        return False
    path = record.write(out, record.as_record(family, result, suite, facts))
    say(f"{family.NAME}: {suite.seconds():.0f} s, {suite.processor_seconds():.0f} s of processor time, {path}")
    return True


def write_reports(options, out):
    names = [f.NAME for f in families.ALL]
    records = record.read_all(out, names)
    if records:
        page = os.path.join(out if options.out else os.path.join(machine.ROOT, "benchmarks"), "report.html")
        there = [one["family"] for one in records]
        html_report.write(page, records, [f.TITLE for f in families.ALL if f.NAME not in there])
        say(page)
    if options.results:
        if not options.report_only:
            keep(options, [one for one in records if not options.only or one["family"] in options.only], names)
        kept = record.read_kept(options.records)
        if not kept:
            raise Failed(f"there is no record in {options.records}")
        markdown_report.write(options.results, kept)
        say(options.results)
    elif not records:
        raise Failed(f"there is no record in {out}")


def keep(options, records, names):
    if options.size == "tiny" and options.records == arguments().get_default("records"):
        raise Failed("a run of size tiny measures nothing; it keeps records only in a folder of its own, with --records")
    try:
        record.keep(options.records, records, names)
    except ValueError as error:
        raise Failed(str(error)) from error


def main():
    options = arguments().parse_args()
    is_built = options.build is not None
    options.build = options.build or os.path.join(machine.ROOT, "build", "release")
    options.records = os.path.abspath(options.records)
    out = os.path.abspath(options.out or os.path.join(options.build, "benchmarks", f"results-{options.size}"))
    wanted = [f for f in families.ALL if not options.only or f.NAME in options.only]
    passed, begin = [], time.monotonic()
    try:
        if not options.report_only:
            if not is_built:
                build()
            if not os.path.exists(os.path.join(options.build, "CMakeCache.txt")):
                say(f"benchmarks/run: {options.build} is no build of CMake; leave out --build to have one made")
                return USAGE
            os.makedirs(out, exist_ok=True)
            begin = time.monotonic()
            options.trajectories = trajectories(options)
            passed = [run_family(family, options, out) for family in wanted]
        write_reports(options, out)
        say(f"{time.monotonic() - begin:.0f} s in all, the build not counted")
    except Failed as error:
        say(f"benchmarks/run: {error}")
        return FAILED
    return OK if all(passed) else FAILED

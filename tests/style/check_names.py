# SPDX-License-Identifier: MIT
"""What the pages for developers name exists: files by their paths, and the functions and tests of docs/thesis-map.md.
Says of each name that leads nowhere where it stands; exit status 1 if there is one.

    check_names.py SOURCE
"""
import pathlib
import re
import sys

PAGES = ["CONTRIBUTING.md", "README.md", "docs/architecture.md", "docs/engine.md", "docs/kinetic.md", "docs/necklaces.md",
         "docs/proximity.md", "docs/python.md", "docs/crossings.md", "docs/zonotopes.md", "docs/reliability.md", "docs/thesis-map.md", "docs/lammps/design.md", "benchmarks/README.md"]
SKIPPED_FOLDERS = re.compile(r"^(\.git|build.*|out)$")  # of the root
# A path in backticks or in brackets behind a name, as in `Nearest` (proximity/src/nearest.cpp, nearest_descent.cpp).
ENDING = r"(?:cpp|hpp|h|py|i|md|toml|cmake|cmake\.in|txt|lmp)"
FILE = re.compile(rf"(?<![\w/.*<{{])(?:\.\./)*((?:[\w.-]+/)*[\w.-]+\.{ENDING})(?![\w/.*])")
FOLDER = re.compile(r"(?<![\w/.*<{-])((?:[\w-]+/)+[\w-]*)(?![\w./*{-])")
TEST = re.compile(r"`([A-Z]\w+)\.(\*|\w+)`|`([A-Z]\w*Test)`")
# As in `Hierarchy::build`.
FUNCTION = re.compile(r"[A-Za-z_]\w*(?:::\w+)*")
TEST_MACRO = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST|HARD_CASE)\(\s*(\w+),\s*(\w+)", re.MULTILINE)


def paths_in(root):
    for path in sorted(root.iterdir()):
        if not SKIPPED_FOLDERS.match(path.name):
            yield path
            if path.is_dir() and not path.is_symlink():
                yield from sorted(path.rglob("*"))


class Tree:
    def __init__(self, root):
        self.paths = ["/" + str(path.relative_to(root)) for path in paths_in(root)]
        self.tails = set()
        for path in self.paths:
            parts = path.split("/")
            self.tails.update("/".join(parts[k:]) for k in range(1, len(parts)))

    def has(self, name):
        return name.rstrip("/") in self.tails


def quoted_parts(line):
    """What stands in backticks."""
    return re.findall(r"`([^`]+)`", line)


def without_code(text):
    """Lines with their numbers, but for those of blocks of code."""
    in_code = False
    for number, line in enumerate(text.split("\n"), start=1):
        if line.startswith("```"):
            in_code = not in_code
        elif not in_code:
            yield number, line


def missing_files(text, tree, top_folders):
    for number, line in without_code(text):
        names = [name for part in quoted_parts(line) + re.findall(r"\(([^()`]*)\)", line) for name in FILE.findall(part)]
        names += [name for part in quoted_parts(line) if " " not in part for name in FOLDER.findall(part)
                  if name.split("/")[0] in top_folders]
        for name in names:
            if not tree.has(name) and "://" not in line[:line.find(name)]:
                yield number, name


def tests_of(root):
    suites = {}
    for path in sorted((root / "tests").rglob("*.[ch]pp")):
        for suite, test in TEST_MACRO.findall(path.read_text(encoding="utf-8")):
            suites.setdefault(suite, set()).add(test)
    return suites


def missing_tests(text, suites):
    for number, line in enumerate(text.split("\n"), start=1):
        for suite, test, alone in TEST.findall(line):
            known = suites.get(suite or alone)
            if known is None or test not in ("", "*") and test not in known:
                yield number, f"{suite}.{test}" if suite else alone


def words_of(root):
    """All names in the sources that are not tests."""
    words = set()
    for folder in sorted(root.glob("*/src")) + sorted(root.glob("*/include")):
        for path in sorted(folder.rglob("*.[ch]pp")):
            words.update(re.findall(r"\w+", path.read_text(encoding="utf-8")))
    return words


def missing_functions(text, words):
    """Of the second column of each table."""
    for number, line in enumerate(text.split("\n"), start=1):
        cells = line.split("|")
        for name in quoted_parts(cells[2]) if len(cells) > 3 else []:
            if FUNCTION.fullmatch(name) and not words.issuperset(name.split("::")):
                yield number, name


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    tree = Tree(root)
    top_folders = {path.name for path in root.iterdir() if path.is_dir() and not SKIPPED_FOLDERS.match(path.name)}
    faults = []
    for page in PAGES:
        text = (root / page).read_text(encoding="utf-8")
        faults += [f"{page}:{number}: there is no file {name}" for number, name in missing_files(text, tree, top_folders)]
    suites = tests_of(root)
    page = "docs/thesis-map.md"
    text = (root / page).read_text(encoding="utf-8")
    faults += [f"{page}:{number}: there is no test {name}" for number, name in missing_tests(text, suites)]
    faults += [f"{page}:{number}: there is no function {name}" for number, name in missing_functions(text, words_of(root))]
    for fault in faults:
        print(fault)
    print(f"{len(PAGES)} pages, {sum(map(len, suites.values()))} tests, {len(faults)} names that lead nowhere")
    return 1 if faults or not suites else 0


if __name__ == "__main__":
    sys.exit(main())

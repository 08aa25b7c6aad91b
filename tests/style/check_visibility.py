# SPDX-License-Identifier: MIT
"""What the public headers of libdch declare is visible, and nothing else: the sources are compiled with hidden symbols, and
each header has its declarations between these lines. Names each header without; exit status 1 if there is one.

    #pragma GCC visibility push(default)
    #pragma GCC visibility pop

    check_visibility.py SOURCE
"""
import pathlib
import re
import sys

FOLDERS = ["lib", "forces", "proximity", "kinetic", "zonotope", "necklace_polymer"]
BETWEEN = re.compile(r"\n#pragma GCC visibility push\(default\)\nnamespace .*\n}  // namespace [\w:]+\n"
                     r"#pragma GCC visibility pop\n", re.DOTALL)


def is_visible(text):
    """Includes stand before, since what they declare has its own visibility."""
    match = BETWEEN.search(text)
    if match is None:
        return "\nnamespace " not in text
    return "\nnamespace " not in text[:match.start()] + text[match.end():] and "\n#include" not in match[0]


def main():
    root = pathlib.Path(sys.argv[1])
    headers = [path for folder in FOLDERS for path in sorted((root / folder / "include").rglob("*.hpp"))]
    faults = [path.relative_to(root) for path in headers if not is_visible(path.read_text(encoding="utf-8"))]
    for path in faults:
        print(f"{path}: put its declarations between the pragmas")
    print(f"{len(headers)} headers, {len(faults)} hidden")
    return 1 if faults or not headers else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""No source file of more than 300 lines and no function of more than 60 without a reason: a comment in the file that
begins with "More than 300 lines" or, right above the function or its head, with "More than 60 lines", and says why.
Names each one without; exit status 1 if there is one.

    check_lengths.py SOURCE
"""
import ast
import pathlib
import re
import sys

SKIPPED_FOLDERS = re.compile(r"^(\.git|build.*|out)$")  # of the root
ENDINGS = {".cpp", ".hpp", ".h", ".i", ".py", ".cmake"}
MAX_LINES, MAX_FUNCTION_LINES = 300, 60
# What opens a block and is no function.
NO_FUNCTION = re.compile(r"(inline )?(namespace|class|struct|enum|union|extern|if|for|while|switch|else|do|try|catch|return)\b"
                         r"|[})]")


def files(root):
    for top in sorted(root.iterdir()):
        if not SKIPPED_FOLDERS.match(top.name):
            yield from (path for path in [top, *sorted(top.rglob("*"))] if is_source(path))


def is_source(path):
    if path.is_symlink() or not path.is_file():
        return False
    return path.suffix in ENDINGS or path.name == "CMakeLists.txt" or not path.suffix and is_script(path)


def is_script(path):
    with path.open("rb") as file:
        return file.read(2) == b"#!"


def without_texts(line):
    """Without what stands in quotes or behind //."""
    line = re.sub(r"//.*", "", re.sub(r'"(\\.|[^"\\])*"', '""', line))
    return re.sub(r"'(\\.|[^'\\])'", "0", line).rstrip()


def indent_of(line):
    return len(line) - len(line.lstrip())


def head_of(lines, k):
    """Where the declaration that opens a block in line k begins: behind the end of another, or a comment."""
    first = k
    while first > 0:
        above = without_texts(lines[first - 1])
        if not above.strip() or above.endswith((";", "{", "}", ":")) or above.lstrip().startswith(("#", "///")):
            break
        first -= 1
    return first


def functions_of_cpp(lines):
    """The first and last line of each function, by the layout that clang-format gives: the brace that closes a block
    begins a line, with the indentation of the block's head. Initializers may end in the middle of one."""
    opened = []
    for k, line in enumerate(map(without_texts, lines)):
        if line.lstrip().startswith("}"):
            while opened and indent_of(lines[opened[-1][0]]) > indent_of(line):
                opened.pop()
            if opened:
                first, is_function = opened.pop()
                if is_function:
                    yield first, k
        if line.endswith("{"):
            first = head_of(lines, k)
            head = " ".join(part.strip() for part in map(without_texts, lines[first:k + 1]))
            head = re.sub(r"^template <[^{]*?> (?=\w)", "", head)
            inside = any(is_function for _, is_function in opened)
            is_function = not inside and "(" in head and not NO_FUNCTION.match(head) and not head.endswith("= {")
            opened.append((first, is_function))


def functions_of_python(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            yield node.lineno - 1, node.end_lineno - 1


def has_reason(lines, first):
    """In the comment above a function, or in its first lines."""
    above = first
    while above > 0 and lines[above - 1].lstrip().startswith(("//", "#")):
        above -= 1
    return any("More than 60 lines" in line for line in lines[above:first + 4])


def faults_of(path):
    text = path.read_text(encoding="utf-8")
    lines = text.split("\n")
    count = text.count("\n")
    if count > MAX_LINES and "More than 300 lines" not in text:
        yield f"{count} lines"
    is_python = path.suffix == ".py" or lines[0].endswith("python3")
    is_cpp = path.suffix in {".cpp", ".hpp", ".h"}
    functions = functions_of_python(text) if is_python else functions_of_cpp(lines) if is_cpp else []
    for first, last in functions:
        # Without the line of the head and that of the brace.
        if last - first - 1 > MAX_FUNCTION_LINES and not has_reason(lines, first):
            yield f"{last - first - 1} lines in the function at line {first + 1}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(files(root))
    faults = [f"{path.relative_to(root)}: {fault}" for path in found for fault in faults_of(path)]
    for fault in faults:
        print(f"{fault}; split it, or say why it is that long")
    print(f"{len(found)} sources, {len(faults)} too long")
    return 1 if faults or not found else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: MIT
"""What can be told of C++ from its text: where functions, brackets and operands begin and end."""
import re

NOT_STATEMENTS = {"return", "const", "auto", "static", "using", "template", "throw", "if", "for", "while", "do", "else",
                  "switch", "case", "default", "struct", "class", "constexpr", "namespace", "public", "private",
                  "typedef", "friend", "enum", "extern", "explicit", "inline", "try", "catch", "delete", "typename"}


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def without_words(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", blank, text, flags=re.S)
    text = re.sub(r'"(\\.|[^"\\\n])*"', lambda m: '"' + " " * (len(m.group(0)) - 2) + '"', text)
    text = re.sub(r"'(\\.|[^'\\\n])'", lambda m: "'" + " " * (len(m.group(0)) - 2) + "'", text)
    text = re.sub(r"^#(\\\n|[^\n])*", blank, text, flags=re.M)
    # What is computed while compiling, and the names of template parameters.
    text = re.sub(r"\b((static|inline)\s+)*constexpr\s+\w[^;{]*=[^;]*;", blank, text)
    return re.sub(r"\b(static_assert|if constexpr|requires)\s*\([^;{]*\)", blank, text)


def function_names(bare):
    """[(position, name)] of what is defined at the left margin or inside a class."""
    found = []
    for match in re.finditer(r"^(  )?[A-Za-z_][^\n;=(){}]*?(~?\w+)\(", bare, flags=re.M):
        if match.group(2) in NOT_STATEMENTS:
            continue
        after = bare[match_forward(bare, match.end() - 1) + 1:]
        if re.match(r"\s*(const\b|noexcept\b|->[^;{]*)*\s*(\{|:\s)", after):
            found.append((match.start(), match.group(2)))
    return found


def match_forward(bare, at):
    """The end of the bracket that opens at `at`."""
    depth = 0
    for k in range(at, len(bare)):
        if bare[k] in "([{":
            depth += 1
        elif bare[k] in ")]}":
            depth -= 1
            if depth == 0:
                return k
    return len(bare)


def operand(bare, at, step, stops):
    """Where the operand beside an operator ends."""
    opening, closing = ("([{", ")]}") if step > 0 else (")]}", "([{")
    depth, k = 0, at
    while 0 <= k < len(bare):
        c = bare[k]
        if c in opening:
            depth += 1
        elif c in closing:
            if depth == 0:
                return k if step > 0 else k + 1
            depth -= 1
        elif depth == 0:
            if c in ",;":
                return k if step > 0 else k + 1
            for stop in stops:
                if step > 0 and bare.startswith(stop, k):
                    return k
                if step < 0 and bare.startswith(stop, k - len(stop) + 1):
                    return k + 1
        k += step
    return k


def trimmed(bare, first, last):
    while first < last and bare[first].isspace():
        first += 1
    while last > first and bare[last - 1].isspace():
        last -= 1
    return first, last

# SPDX-License-Identifier: MIT
"""Mutants of a C++ source in the project's format: finds them, and writes all of them into one source in which the
number of a mutant chooses it when the program runs. Text alone is looked at, so it counts on clang-format: operators
with two operands have spaces around them, brackets of templates have not."""
import re
from dataclasses import dataclass, field

from cpp_text import NOT_STATEMENTS, function_names, match_forward, operand, trimmed, without_words

RELATIONS = {"<": ("<", ["<=", ">="]), "<=": ("l", ["<", ">"]), ">": (">", [">=", "<="]), ">=": ("g", [">", "<"]),
             "==": ("=", ["!="]), "!=": ("!", ["=="])}
# Margins and slacks, and what is left of a sum or product without them.
MARGINS = {"kInflate": "1.0", "kEdgeSlack": "0.0", "kMotionSlack": "0.0", "kOff": "0.0", "wrap_slack": "0.0"}
DECLARATION = re.compile(r"(const\s+)?[A-Za-z_][\w:]*(<[^;=()]*>)?(::\w+)?[&*]?\s+(const\s+)?"
                         r"[&*]?[A-Za-z_]\w*\s*[=;{(,\[]")


@dataclass
class Mutant:
    number: int
    function: str
    line: int
    what: str  # the line with the change in it
    name: str = ""  # the same for as long as the function's text is


@dataclass
class Source:
    text: str
    bare: str = ""  # without comments, strings and directives, character by character
    events: list = field(default_factory=list)
    mutants: list = field(default_factory=list)

    def line_of(self, at):
        return self.text.count("\n", 0, at) + 1


class Mutator:
    def __init__(self, text, skip_functions=(), skip_lines=None):
        self.source = Source(text, without_words(text))
        self.functions = function_names(self.source.bare)
        self.skip_functions = set(skip_functions)
        self.skip_lines = re.compile(skip_lines) if skip_lines else None
        self.dropped_lines = set()

    def function_at(self, at):
        name = ""
        for begin, word in self.functions:
            if begin > at:
                break
            name = word
        return name

    def line_text(self, at):
        begin = self.source.text.rfind("\n", 0, at) + 1
        end = self.source.text.find("\n", at)
        return begin, self.source.text[begin:end]

    def add(self, at, length, replacement, kind=""):
        """The number of a new mutant, or None where there should be none."""
        function = self.function_at(at)
        line = self.source.line_of(at)
        begin, text = self.line_text(at)
        if function in self.skip_functions or line in self.dropped_lines:
            return None
        if self.skip_lines and self.skip_lines.search(text):
            return None
        first = at - begin
        if kind:
            what = f"{kind}: {' '.join(self.source.text[at:at + length].split())}"
        else:
            what = (text[:first] + "{" + text[first:first + length] + " -> " + replacement + "}" +
                    text[first + length:]).strip()
        number = len(self.source.mutants) + 1
        self.source.mutants.append(Mutant(number, function, line, what))
        return number

    def replace(self, at, length, text):
        self.source.events.append((at, 2, 0, text, length))

    def wrap(self, first, last, before, after):
        self.source.events.append((first, 1, -(last - first), before, 0))
        self.source.events.append((last, 0, last - first, after, 0))

    def relations(self):
        for match in re.finditer(r"(?<=\s)(<=|>=|==|!=|<|>)(?=\s)", self.source.bare):
            token = match.group(1)
            if re.search(r"\boperator$|\btemplate$", self.source.bare[:match.start()].rstrip()[-10:]):
                continue
            symbol, variants = RELATIONS[token]
            numbers = [self.add(match.start(), len(token), variant) for variant in variants]
            if numbers[0] is None:
                continue
            middle = f"::mutants::Relation<'{symbol}', {numbers[0]}>()"
            both = ("==", "==") if symbol in "=!" else ("<", ">")
            self.replace(match.start(), len(token), f"{both[0]} {middle} {both[1]}")

    def sums(self):
        for match in re.finditer(r"(?<=[\w)\]}]\s)([+-])(?=\s)", self.source.bare):
            if re.search(r"\b(return|case)\s$", self.source.bare[:match.start()][-8:]):
                continue
            token = match.group(1)
            number = self.add(match.start(), 1, "-" if token == "+" else "+")
            if number:
                self.replace(match.start(), 1, f"+ ::mutants::Sum<'{token}', {number}>() +")

    def constants(self):
        for name, neutral in MARGINS.items():
            for match in re.finditer(rf"(?<![\w.>:]){name}\b(?!\s*=[^=])", self.source.bare):
                number = self.add(match.start(), len(name), neutral)
                if number:
                    self.replace(match.start(), len(name), f"(::mutants::is({number}) ? {neutral} : {name})")
        factor = r"(?<![\w.)\]])(\d+(?:\.\d+)?)(?= \* )|(?<= \* )(\d+(?:\.\d+)?)(?![\w.(])"
        for match in re.finditer(factor, self.source.bare):
            self.literal(match, "1")
        for match in re.finditer(r"(?<=[\w)\]] [+-] )(\d+(?:\.\d+)?(?:e-?\d+)?)(?![\w.(]| \*| /)", self.source.bare):
            self.literal(match, "0")

    def literal(self, match, neutral):
        token = match.group(0)
        if float(token) == float(neutral):
            return
        number = self.add(match.start(), len(token), neutral)
        if number:
            same_type = neutral + (".0" if "." in token or "e" in token else "")
            self.replace(match.start(), len(token), f"(::mutants::is({number}) ? {same_type} : {token})")

    def extremes(self):
        for match in re.finditer(r"\bstd::(min|max)(<[^>()]*>)?\((?!\{)", self.source.bare):
            token = match.group(1)
            number = self.add(match.start(1), 3, "max" if token == "min" else "min")
            if not number:
                continue
            type_name = ", " + match.group(2)[1:-1] if match.group(2) else ""
            largest = "true" if token == "max" else "false"
            self.replace(match.start(), len(match.group(0)), f"::mutants::extreme<{number}, {largest}{type_name}>(")

    def clauses(self):
        for token, stops in ((" && ", [" && ", " || ", " ? ", " : ", " = ", "return "]),
                             (" || ", [" || ", " ? ", " : ", " = ", "return "])):
            seen = set()
            for match in re.finditer(r"\s(&&|\|\|)\s", self.source.bare):
                if match.group(1) != token.strip():
                    continue
                stops_here = [stop.strip() if stop.strip() in ("&&", "||") else stop for stop in stops]
                bare = self.source.bare.replace("\n", " ")  # stops may stand at the end of a line
                spans = [trimmed(bare, operand(bare, match.start(), -1, stops_here), match.start()),
                         trimmed(bare, match.end(), operand(bare, match.end(), 1, stops_here))]
                for first, last in spans:
                    if (first, last) in seen or first >= last:
                        continue
                    seen.add((first, last))
                    number = self.add(first, last - first, "", "without the clause")
                    if number:
                        whether = f"::mutants::is({number})"
                        before = f"({whether} || (" if token == " && " else f"(!{whether} && ("
                        self.wrap(first, last, before, "))")

    def conditions(self):
        for match in re.finditer(r"\b(if|while) \(", self.source.bare):
            first, last = match.end(), match_forward(self.source.bare, match.end() - 1)
            condition = self.source.bare[first:last]
            if re.search(r"\s(<|>|<=|>=|==|!=|&&|\|\||=)\s|;", condition):
                continue
            number = self.add(first, last - first, "", "negated")
            if number:
                self.wrap(first, last, f"::mutants::is({number}) != static_cast<bool>(", ")")
        for match in re.finditer(r"\breturn (true|false);", self.source.bare):
            number = self.add(match.start(1), len(match.group(1)), "true" if match.group(1) == "false" else "false")
            if number:
                self.replace(match.start(1), len(match.group(1)), f"(::mutants::is({number}) != {match.group(1)})")

    def statements(self):
        bare = self.source.bare
        starts = [m.end() for m in re.finditer(r"[;{}]|\belse\b", bare)]
        for match in re.finditer(r"\b(if|for|while) \(", bare):
            starts.append(match_forward(bare, match.end() - 1) + 1)
        for start in sorted(set(starts)):
            first, _ = trimmed(bare, start, len(bare))
            if first >= len(bare) or bare[first] in "{};#)" or not self.is_in_block(first):
                continue
            last = self.end_of_statement(first)
            if last is None or not self.is_removable(bare[first:last]):
                continue
            if first == self.source.text.rfind("\n", 0, first) + 1:
                continue
            number = self.add(first, last - first, "", "without")
            if number:
                self.wrap(first, last, f"{{ if (!::mutants::is({number})) {{ ", " } }")

    def is_in_block(self, at):
        """Whether the innermost bracket around is a brace, not that of a loop's head."""
        depth = 0
        for k in range(at - 1, -1, -1):
            c = self.source.bare[k]
            if c in ")]}":
                depth += 1
            elif c in "([{":
                if depth == 0:
                    return c == "{"
                depth -= 1
        return False

    def end_of_statement(self, first):
        depth = 0
        for k in range(first, min(first + 600, len(self.source.bare))):
            c = self.source.bare[k]
            if c in "([{":
                depth += 1
            elif c in ")]}":
                depth -= 1
                if depth < 0:
                    return None
            elif c == ";" and depth == 0:
                return k + 1
        return None

    @staticmethod
    def is_removable(statement):
        if statement in ("continue;", "break;", "return;"):
            return True
        word = re.match(r"~?\w*", statement).group(0)
        if word in NOT_STATEMENTS or DECLARATION.match(statement):
            return False
        return bool(re.search(r"\)\s*;$| (=|[-+*/|&]=) |^(\+\+|--)", statement))

    def run(self):
        self.relations()
        self.sums()
        self.constants()
        self.extremes()
        self.clauses()
        self.conditions()
        self.statements()
        seen = {}
        for mutant in self.source.mutants:
            name = f"{mutant.function}: {mutant.what}"
            seen[name] = seen.get(name, 0) + 1
            mutant.name = name + (f" #{seen[name]}" if seen[name] > 1 else "")
        return self

    def schemata(self):
        """The source with all mutants in it."""
        out, at = ['#include "mutants.hpp"\n#line 1\n'], 0
        for position, _, _, text, length in sorted(self.source.events, key=lambda event: event[:3]):
            out.append(self.source.text[at:position])
            out.append(text)
            at = position + length
        out.append(self.source.text[at:])
        return "".join(out)


def mutants_of(text, skip_functions=(), skip_lines=None, dropped_lines=()):
    mutator = Mutator(text, skip_functions, skip_lines)
    mutator.dropped_lines = set(dropped_lines)
    return mutator.run()

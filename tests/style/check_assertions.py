# SPDX-License-Identifier: MIT
"""Assertions, ours and those of the C++ library, are compiled into all sources of a build that asks for them and into
none of another; and the presets ask for them that should. Names each source or preset that differs; exit status 1 if
there is one.

    check_assertions.py SOURCE BUILD on|off
"""
import json
import pathlib
import shlex
import sys

ASKED_FOR = {"dev": True, "clang": True, "release": False}


def asks(presets, name):
    """Whether a preset turns assertions on, by itself or by those that it inherits."""
    own = presets[name].get("cacheVariables", {}).get("DCH_ASSERTIONS")
    inherited = presets[name].get("inherits", [])
    above = [inherited] if isinstance(inherited, str) else inherited
    return own == "ON" if own else any(asks(presets, other) for other in above)


def wrong_presets(source):
    content = json.loads((source / "CMakePresets.json").read_text(encoding="utf-8"))
    presets = {preset["name"]: preset for preset in content["configurePresets"]}
    return [f"preset {name}: assertions are {'off' if wanted else 'on'}" for name, wanted in ASKED_FOR.items()
            if asks(presets, name) != wanted]


def has_assertions(words):
    """By the last word that defines NDEBUG or undefines it."""
    about = [word for word in words if word.startswith(("-DNDEBUG", "-UNDEBUG"))]
    return "-D_GLIBCXX_ASSERTIONS" in words and (not about or about[-1] == "-UNDEBUG")


def wrong_sources(source, build, wanted):
    """Of the sources of this project, one by one or some together, not of those that a build generates."""
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    ours = [c for c in commands if source in (file := pathlib.Path(c["file"])).parents
            and (build not in file.parents or file.parent.name == "Unity")]
    found = [f"{c['file']}: compiled {'without' if wanted else 'with'} assertions" for c in ours
             if has_assertions(shlex.split(c["command"])) != wanted]
    return len(ours), found


def main():
    source, build = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    count, wrong = wrong_sources(source, build, {"on": True, "off": False}[sys.argv[3]])
    wrong += wrong_presets(source)
    for message in wrong:
        print(message)
    print(f"{count} sources, {len(wrong)} mistakes")
    sys.exit(1 if wrong or not count else 0)


if __name__ == "__main__":
    main()

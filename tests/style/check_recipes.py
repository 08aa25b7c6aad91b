#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the recipes for Spack and conda-forge against the project: options of CMake, components, headers, programs, the
license and what is needed to build. That the versions agree, check_versions.py says.

usage: check_recipes.py ROOT; exit status 1 if they do not.
"""
import ast
import pathlib
import re
import sys

import yaml

SPACK, CONDA = "packaging/spack/package.py", "packaging/conda/recipe.yaml"
# What CMake finds, by its names in Spack and at conda-forge. Of tests and hosts neither recipe knows.
PACKAGES = {"ZLIB": {"zlib-api", "zlib"}, "HDF5": {"hdf5"}, "fmt": {"fmt"}, "CLI11": {"cli11"},
            "nlohmann_json": {"nlohmann-json", "nlohmann_json"}, "Eigen3": {"eigen"}, "Boost": {"boost", "libboost-headers"}}
PARTS = ["lib", "forces", "proximity", "kinetic", "zonotope", "necklace_polymer", "trajectory", "replay"]


def options_of(root):
    return set(re.findall(r"^option\((\w+)", (root / "CMakeLists.txt").read_text(), re.MULTILINE))


def wanted_by_cmake(root):
    """What the parts that recipes build look for."""
    for part in PARTS:
        yield from re.findall(r"^find_package\((\w+)", (root / part / "CMakeLists.txt").read_text(), re.MULTILINE)


def wrong_dependencies(root, recipe, named):
    for package in sorted(set(wanted_by_cmake(root))):
        if not PACKAGES.get(package, set()) & named:
            yield f"{recipe} lacks what CMake finds as {package}"
    for name in sorted(named - set().union(*PACKAGES.values())):
        yield f"{recipe} needs {name}, which CMake does not look for"


def calls(tree, name):
    return [node for node in ast.walk(tree) if isinstance(node, ast.Call)
            and name in (getattr(node.func, "id", None), getattr(node.func, "attr", None))]


def texts(tree, name, which=0):
    return [ast.literal_eval(call.args[which]) for call in calls(tree, name)]


def wrong_spack(root):
    text = (root / SPACK).read_text()
    tree = ast.parse(text)
    if "SPDX-License-Identifier: (Apache-2.0 OR MIT)" not in text:
        yield f"{SPACK} has not the license that Spack asks of recipes"
    if texts(tree, "license") != ["MIT"]:
        yield f"{SPACK}: the license is not MIT"
    parts = next(node for node in ast.walk(tree) if isinstance(node, ast.Assign))
    used = [*texts(tree, "define_from_variant"), *(f"DCH_BUILD_{part}" for part in ast.literal_eval(parts.value))]
    for option in options_of(root):
        if (option.startswith("DCH_BUILD_") or option == "BUILD_SHARED_LIBS") and option not in used:
            yield f"{SPACK} leaves {option} open"
    for option in set(used) - options_of(root):
        yield f"{SPACK}: CMakeLists.txt has no option {option}"
    for variant in set(texts(tree, "define_from_variant", 1)) ^ set(texts(tree, "variant")):
        yield f"{SPACK}: {variant} is no variant, or sets nothing"
    minimum = cmake_minimum(root)
    named = set(texts(tree, "depends_on")) - {"c", "cxx"}
    if f"cmake@{minimum}:" not in named:
        yield f"{SPACK} does not need CMake {minimum}"
    yield from wrong_dependencies(root, SPACK, named - {f"cmake@{minimum}:"})


def cmake_minimum(root):
    return re.search(r"^cmake_minimum_required\(VERSION (\S+)\)", (root / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def wrong_output(root, output):
    name, script = output["package"]["name"], output["build"]["script"]
    for option in set(re.findall(r"-D(\w+)=", " ".join(script))) - options_of(root):
        yield f"{CONDA}, {name}: CMakeLists.txt has no option {option}"
    components = (root / "cmake" / "DchInstall.cmake").read_text()
    for component in re.findall(r"--component (\S+)", " ".join(script)):
        if not re.search(rf"\b{component}\b", components):
            yield f"{CONDA}, {name}: no component {component}"
    if f"cmake >={cmake_minimum(root)}" not in output["requirements"]["build"]:
        yield f"{CONDA}, {name} does not need CMake {cmake_minimum(root)}"
    if "tests" not in output:
        yield f"{CONDA}, {name} has no tests"
    for test in output.get("tests", []):
        for header in test.get("package_contents", {}).get("include", []):
            if not (root / "lib" / "include" / header).is_file():
                yield f"{CONDA}, {name}: no header {header}"


def wrong_conda(root):
    recipe = yaml.safe_load((root / CONDA).read_text())
    about = recipe["about"]
    if about["license"] != "MIT" or not (root / about["license_file"]).is_file():
        yield f"{CONDA}: the license is not MIT, or its file is not there"
    if recipe["schema_version"] != 1 or not (root / CONDA).parent.joinpath(recipe["source"]["path"]).samefile(root):
        yield f"{CONDA}: another schema, or other sources"
    named = set()
    for output in recipe["outputs"]:
        yield from wrong_output(root, output)
        named |= set(output["requirements"].get("host", []))
    yield from wrong_dependencies(root, CONDA, named)


def main():
    if len(sys.argv) != 2:
        print(__doc__.splitlines()[3], file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    found = [*wrong_spack(root), *wrong_conda(root)]
    print("\n".join(found) or "both recipes agree with the project")
    return 1 if found else 0


sys.exit(main())

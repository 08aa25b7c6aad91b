# SPDX-License-Identifier: MIT
"""Builds the module dch for a wheel: what CMake makes of python/, with the libraries in it."""
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent
BUILD = ROOT / "build" / "wheel" / sys.implementation.cache_tag
UNNEEDED = ["BENCHMARKS", "KINETIC", "LAMMPS", "OPENMM", "POWER_DIAGRAM", "REPLAY", "TESTS", "ZONOTOPE"]


def version():
    return re.search(r"^project\(dch VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        settings = [f"-DPython3_EXECUTABLE={sys.executable}", "-DCMAKE_BUILD_TYPE=Release", "-DDCH_JOIN_SOURCES=ON",
                    "-DBUILD_SHARED_LIBS=OFF", *(f"-DDCH_BUILD_{part}=OFF" for part in UNNEEDED)]
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", BUILD, *settings], check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "dch_python", "--parallel"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        self.copy_file(BUILD / "python" / "dch" / target.name, target)


BUILD.mkdir(parents=True, exist_ok=True)
setup(version=version(), packages=["dch"], package_dir={"dch": "python/dch"}, package_data={"dch": ["*.pyi", "py.typed"]},
      ext_modules=[Extension("dch._core", sources=[])], cmdclass={"build_ext": BuildByCMake},
      options={"egg_info": {"egg_base": str(BUILD)}, "build": {"build_base": str(BUILD / "setuptools")}})

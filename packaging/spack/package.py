# Copyright Spack Project Developers. See COPYRIGHT file for details.
#
# SPDX-License-Identifier: (Apache-2.0 OR MIT)
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Dch(CMakePackage):
    """Neighbor lists for molecular dynamics from discrete center hierarchies: libraries for C++, and dchmd, a command
    for trajectories."""

    # No release has an address yet: homepage, url, sha256 and maintainers() go here. Until then `spack dev-build dch@0.1.0`
    # in a checkout.
    license("MIT")

    version("0.1.0")

    variant("shared", default=True, description="Build libdch, the shared library, beside the static ones")
    variant("kinetic", default=True, description="Events of points whose motion is known")
    variant("replay", default=True, description="Readers and writers of trajectories, and the command dchmd")
    variant("zonotope", default=True, description="Zonotopes")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    with when("+replay"):
        depends_on("hdf5")
        depends_on("zlib-api")
        depends_on("fmt")
        depends_on("cli11", type="build")
        depends_on("nlohmann-json", type="build")
    with when("+zonotope"):
        depends_on("boost", type="build")
        depends_on("eigen", type="build")

    conflicts("platform=darwin", msg="version scripts of the linker, and seccomp, are Linux's")
    conflicts("platform=windows", msg="version scripts of the linker, and seccomp, are Linux's")
    conflicts("+replay ~kinetic", msg="dchmd has commands for events")

    def cmake_args(self):
        hosts_and_tests = ["BENCHMARKS", "LAMMPS", "OPENMM", "POWER_DIAGRAM", "PYTHON", "TESTS", "ZONOTOPE_FIT"]
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("DCH_BUILD_KINETIC", "kinetic"),
            self.define_from_variant("DCH_BUILD_REPLAY", "replay"),
            self.define_from_variant("DCH_BUILD_ZONOTOPE", "zonotope"),
            *(self.define(f"DCH_BUILD_{part}", False) for part in hosts_and_tests),
        ]

    def test_hard_spheres(self):
        """a run of hard spheres, and its lists against all pairs"""
        if not self.spec.satisfies("+replay"):
            raise SkipTest("dchmd is part of dch+replay")
        dchmd = which(self.prefix.bin.dchmd)
        dchmd("hardspheres", "--spheres", "500", "--fraction", "0.3", "--time", "2", "--every", "0.5", "--out", "run.h5")
        dchmd("replay", "run.h5", "--cutoff", "1.5", "--verify", "all")

# SPDX-License-Identifier: MIT
"""What a program under comparison is to the script `compare`."""

import dataclasses
import os
import subprocess
import typing


class Missing(Exception):
    """The program, or a part of the build, is not there; says what provides it."""


class Failed(Exception):
    """A program ended badly."""


@dataclasses.dataclass
class Precision:
    """What a program's forces and energies have to agree to with all pairs in double precision, and why."""
    rms: float      # root mean square of the differences of forces, over that of forces
    largest: float  # largest difference of a force, over the root mean square of forces
    energy: float   # difference of energies, over the energy
    why: str


DOUBLE = Precision(1e-12, 1e-11, 1e-12, "double throughout: rounding in sums of hundreds of pairs that nearly cancel")
SINGLE = Precision(5e-6, 1e-4, 1e-5, "single precision: coordinates of 1 to 4 nm are rounded to 1e-7 nm, and forces of close "
                   "pairs grow with the 13th power of their distance")
MIXED = Precision(2e-6, 5e-5, 1e-6, "pairs in single precision, relative to points near them; sums in double")


@dataclasses.dataclass
class Program:
    name: str
    run: typing.Callable   # (scene) -> all_pairs.Answer, in kJ/mol and nm; raises Missing or Failed
    units: str             # those that the program computes in, and how they are converted
    constant: float        # of Coulomb's law, as the program has it, in kJ nm/mol/e^2
    precision: Precision
    field_between_bonded: bool = False  # see all_pairs.answer


def run(command, folder, text="", refusal=None):
    """Standard output of a program that gets `text` as its input.

    A program that ends badly and prints `refusal` is missing here, whatever its package has installed.
    """
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_hwloc_base_binding_policy="none")
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, input=text, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if done.returncode != 0:
        if refusal and refusal in done.stdout:
            raise Missing(f"{command[0]} does not run here: {refusal}")
        raise Failed(f"{command[0]} ended with status {done.returncode}:\n{done.stdout[-1500:]}")
    return done.stdout

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <dch/forces/embedded_atoms.hpp>

namespace dch::lammps {

/// The formats of DYNAMO in which LAMMPS's styles eam, eam/alloy and eam/fs read potentials.
enum class EamFormat {
  funcfl,          ///< one element a file
  setfl,           ///< several, each with one function for the density
  finnis_sinclair  ///< several, whose densities depend on the element that they are for
};

/// What a file says. Functions are given at equal distances from 0 on.
struct EamFile {
  std::string units;  ///< those that its first line names; empty if it names none
  std::vector<std::string> elements;
  double density_step = 0, distance_step = 0;
  std::vector<std::vector<double>> embeddings;  ///< by element
  /// By element that makes the density; of the last format by that, then by the one that it is for.
  std::vector<std::vector<double>> densities;
  /// Of pairs of elements a >= b, a (a + 1) / 2 + b; of the first format the element's effective charge.
  std::vector<std::vector<double>> pairs;
};

/// @returns no elements for a file that is not of this format
EamFile read_eam(const std::string& text, EamFormat format);

/// Functions of types, each of which is of an element of a file or of none.
struct EamTypes {
  struct Element {
    int file = -1;  ///< none: no functions
    int number = 0;
  };
  std::vector<Element> elements;  ///< by type
};

/// Files of one element that differ in their distances are read between these, as the plain style does.
/// Without a cutoff.
/// @param files those that types name are there
EmbeddedAtomParams functions_of(const std::vector<EamFile>& files, EamFormat format, const EamTypes& types);

}  // namespace dch::lammps

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <error.h>
#include <lammps_host.h>
#include <memory.h>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// What a bond or angle style whose forces come from a kernel takes from the plain style that it keeps.
template <class Style>
class PlainStyle {
 public:
  /// @param kind "bond" or "angle", for messages
  /// @param coefficients how many numbers a type has
  /// @param made by LAMMPS; null if there is no such style
  PlainStyle(const char* kind, const char* name, std::size_t coefficients, Style* made, Error& error)
      : kind_(kind), name_(name), count_(coefficients), style_(made) {
    if (!style_)
      error.all(FLERR, title() + " needs the plain style " + name_ + ", which this LAMMPS was built without");
  }

  const std::string& kind() const { return kind_; }
  std::string name() const { return name_ + "/dch"; }
  /// "Bond style harmonic/dch", for messages.
  std::string title() const {
    std::string words = kind_ + " style " + name();
    words[0] = static_cast<char>(std::toupper(words[0]));
    return words;
  }

  Style* operator->() const { return style_.get(); }

  /// LAMMPS looks at which types have been given.
  void copy_flags(int types, int*& flags, int& allocated, Memory& memory) const {
    if (!style_->allocated) return;
    if (!allocated) {
      allocated = 1;
      memory.create(flags, types + 1, "dch:setflag");
    }
    std::copy_n(style_->setflag, types + 1, flags);
  }

  /// Coefficients of the first kind of all types, then of the next. The plain style keeps them to itself, but
  /// writes them to restart files.
  std::vector<double> coefficients(int types, Error& error) const {
    char* text = nullptr;
    std::size_t size = 0;
    std::FILE* const file = open_memstream(&text, &size);
    if (!file) error.one(FLERR, title() + ": out of memory");
    style_->write_restart(file);
    std::fclose(file);
    std::vector<double> values(count_ * static_cast<std::size_t>(types));
    const bool fits = size == values.size() * sizeof(double);
    if (fits) std::copy_n(text, size, reinterpret_cast<char*>(values.data()));
    std::free(text);
    if (!fits)
      error.one(FLERR,
                title() + " does not know the restart data of this LAMMPS's style " + name_ + "; use that");
    return values;
  }

  /// Takes over what the plain style has computed.
  /// @param atoms that energies and virials by atom are for, if they are not null
  void copy_sums(int atoms, double& energy, double* virial, double* energies, double** virials) const {
    energy = style_->energy;
    std::copy_n(style_->virial, 6, virial);
    if (energies) std::copy_n(style_->eatom, atoms, energies);
    if (virials) copy_rows(atoms, style_->vatom, 6, virials);
  }

  static void copy_rows(int rows, double* const* from, int columns, double** to) {
    for (int i = 0; i < rows; ++i) std::copy_n(from[i], columns, to[i]);
  }

 private:
  std::string kind_, name_;
  std::size_t count_;
  std::unique_ptr<Style> style_;
};

}  // namespace LAMMPS_NS

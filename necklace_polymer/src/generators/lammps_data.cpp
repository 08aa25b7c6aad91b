// SPDX-License-Identifier: MIT
#include <charconv>
#include <ostream>
#include <string>

#include <dch/necklace/melt.hpp>

namespace dch::necklace {

namespace {

/// Appends numbers with single spaces between them, in the shortest form that is read back exactly.
class Line {
 public:
  template <class Number>
  Line& operator<<(Number value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    if (!text_.empty()) text_ += ' ';
    text_.append(digits, end);
    return *this;
  }
  std::string text(const char* ending = "\n") { return text_ + ending; }

 private:
  std::string text_;
};

}  // namespace

void write_lammps_data(std::ostream& out, const Melt& melt) {
  const std::size_t beads = melt.positions.size();
  out << "bead-spring melt\n\n"
      << (Line() << beads).text(" atoms\n") << (Line() << melt.bonds.size()).text(" bonds\n")
      << "1 atom types\n1 bond types\n\n";
  const char* const bounds[] = {" xlo xhi\n", " ylo yhi\n", " zlo zhi\n"};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = melt.box.origin()[axis];
    out << (Line() << low << low + melt.box.vector(axis)[axis]).text(bounds[axis]);
  }
  out << "\nMasses\n\n1 1\n\nAtoms # bond\n\n";
  for (std::size_t k = 0; k < beads; ++k) {
    const Vec3 p = melt.positions[k];
    const auto& image = melt.images[k];
    out << (Line() << k + 1 << melt.molecules[k] << 1 << p.x << p.y << p.z << image[0] << image[1]
                   << image[2])
               .text();
  }
  if (melt.bonds.empty()) return;
  out << "\nBonds\n\n";
  for (std::size_t k = 0; k < melt.bonds.size(); ++k) {
    out << (Line() << k + 1 << 1 << melt.bonds[k][0] + 1 << melt.bonds[k][1] + 1).text();
  }
}

}  // namespace dch::necklace

// SPDX-License-Identifier: MIT
#include "lammps/lammps_dump_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>

#include "base/text.hpp"
#include "lammps/lammps_units.hpp"

namespace dch::trajectory {
namespace {

using Role = DumpColumns::Role;

}  // namespace

LammpsDumpReader::LammpsDumpReader(const std::string& path, const ReadLimits& limits)
    : lines_(path, FinalNewline::required, limits), header_reader_(lines_) {
  lines_.set_frame(0);
  header_reader_.read_leading_units();
}

std::string LammpsDumpReader::length_unit() const {
  const LammpsUnits* units = find_lammps_units(header_reader_.units());
  return units != nullptr ? std::string(units->length) : "the dump's unit";
}

bool LammpsDumpReader::read(Frame& frame) {
  lines_.set_frame(frames_);
  if (!header_reader_.read(header_)) {
    if (frames_ == 0) lines_.fail_here("the file holds no frame");
    return false;
  }
  check_same_atoms();
  read_atoms(frame);
  sort_by_id(frame);
  frame.step = header_.step;
  frame.time = header_.time;
  const LammpsUnits* units = find_lammps_units(header_reader_.units());
  if (frame.time && units != nullptr && units->picoseconds > 0) *frame.time *= units->picoseconds;
  frame.box = header_.box;
  ++frames_;
  return true;
}

void LammpsDumpReader::read_atoms(Frame& frame) {
  frame.positions.clear();
  frame.ids.clear();
  frame.types.clear();
  frame.molecules.clear();
  frame.images.clear();
  first_atom_line_ = lines_.number() + 1;
  std::string_view line;
  for (std::int64_t row = 0; row < header_.atoms; ++row) {
    if (!lines_.next(line)) {
      lines_.fail_here(
          fmt::format("the file ends after {} of the frame's {} atoms: it is truncated", row, header_.atoms));
    }
    read_atom(line, frame);
  }
  if (!header_.columns.has_id) {
    frame.ids.resize(frame.positions.size());
    std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
  }
}

void LammpsDumpReader::read_atom(std::string_view line, Frame& frame) {
  if (line.substr(0, 5) == "ITEM:") {
    lines_.fail_here(fmt::format("the next item begins after {} of the frame's {} atoms",
                                 lines_.number() - first_atom_line_, header_.atoms));
  }
  const DumpColumns& columns = header_.columns;
  Vec3 position;
  std::int64_t id = 0;
  std::int32_t molecule = 0, type = 0;
  std::array<std::int32_t, 3> image{};
  std::size_t column = 0;
  std::string_view rest = line, word;
  for (; column < columns.roles.size() && next_word(rest, word); ++column) {
    switch (columns.roles[column]) {
      case Role::ignored:
        break;
      case Role::id:
        read_field(word, "an atom id", id);
        break;
      case Role::molecule:
        read_field(word, "a molecule number", molecule);
        break;
      case Role::type:
        read_field(word, "an atom type", type);
        break;
      case Role::x:
        read_field(word, "the coordinate x", position.x);
        break;
      case Role::y:
        read_field(word, "the coordinate y", position.y);
        break;
      case Role::z:
        read_field(word, "the coordinate z", position.z);
        break;
      case Role::ix:
        read_field(word, "the image flag ix", image[0]);
        break;
      case Role::iy:
        read_field(word, "the image flag iy", image[1]);
        break;
      case Role::iz:
        read_field(word, "the image flag iz", image[2]);
        break;
    }
  }
  if (column < columns.roles.size() || !is_blank(rest)) {
    lines_.fail_here(fmt::format("expected {} fields, one for each column of 'ITEM: ATOMS', found {}",
                                 columns.roles.size(), in_quotes(line)));
  }
  if (columns.scaled) position = unscaled(position);
  if (!is_valid_position(position)) {
    lines_.fail_here(fmt::format("a coordinate is not finite or larger than {:g}", kMaxCoordinate));
  }
  frame.positions.push_back(position);
  if (columns.has_id) frame.ids.push_back(id);
  if (columns.has_molecule) frame.molecules.push_back(molecule);
  if (columns.has_type) frame.types.push_back(type);
  if (columns.has_images) frame.images.push_back(image);
}

template <class T>
void LammpsDumpReader::read_field(std::string_view word, const char* what, T& value) const {
  if (!parse_number(word, value))
    lines_.fail_here(fmt::format("expected {}, found {}", what, in_quotes(word)));
}

Vec3 LammpsDumpReader::unscaled(Vec3 p) const {
  const Cell& cell = header_.cell;
  return cell.origin + p.x * cell.edges[0] + p.y * cell.edges[1] + p.z * cell.edges[2];
}

void LammpsDumpReader::sort_by_id(Frame& frame) {
  const auto repeated = sorter_.sort_by_id(frame);
  if (!repeated) return;
  lines_.fail_in_line(first_atom_line_ + repeated->second,
                      fmt::format("the atom id {} appears a second time (first in line {})", repeated->id,
                                  first_atom_line_ + repeated->first));
}

void LammpsDumpReader::check_same_atoms() {
  const bool has_id = header_.columns.has_id;
  if (frames_ == 0) {
    first_has_id_ = has_id;
    first_atoms_ = header_.atoms;
  } else if (has_id != first_has_id_) {
    lines_.fail_here(has_id ? "the frame has a column of ids, the first frame has none"
                            : "the frame has no column of ids, the first frame has one");
  } else if (!has_id && header_.atoms != first_atoms_) {
    lines_.fail_in_line(
        header_.atoms_line,
        fmt::format("the frame has {} atoms, the first frame {}; without ids the number must not change "
                    "(dump the column id)",
                    header_.atoms, first_atoms_));
  }
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "lammps/lammps_dump_writer.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "frames/frame_check.hpp"

namespace dch::trajectory {
namespace {

std::string boundary_letters(const Box& box) {
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) letters += box.periodic(axis) ? " pp" : " ff";
  return letters;
}

/// LAMMPS's own triclinic cells: a along x, b in the xy plane, positive extents.
bool is_restricted(const Box& box) {
  const Vec3 a = box.vector(0), b = box.vector(1), c = box.vector(2);
  return a.y == 0 && a.z == 0 && b.z == 0 && a.x > 0 && b.y > 0 && c.z > 0;
}

}  // namespace

LammpsDumpWriter::LammpsDumpWriter(const std::string& path, const std::string& length_unit)
    : file_(path), units_(find_lammps_units_by_length(length_unit)) {}

void LammpsDumpWriter::write(const Frame& frame) {
  check_frame(frame, file_.path(), frames_);
  append_header(frame);
  append_box(frame.box);
  append_atoms(frame);
  flush();
  ++frames_;
}

void LammpsDumpWriter::append_header(const Frame& frame) {
  const auto out = std::back_inserter(text_);
  if (frames_ == 0 && units_ != nullptr) fmt::format_to(out, "ITEM: UNITS\n{}\n", units_->style);
  if (frame.time) {
    const double unit = units_ != nullptr && units_->picoseconds > 0 ? units_->picoseconds : 1;
    fmt::format_to(out, "ITEM: TIME\n{}\n", *frame.time / unit);
  }
  fmt::format_to(out, "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", frame.step, frame.positions.size());
}

void LammpsDumpWriter::append_box(const Box& box) {
  const auto out = std::back_inserter(text_);
  const Vec3 o = box.origin(), a = box.vector(0), b = box.vector(1), c = box.vector(2);
  if (box.kind() == Box::Kind::triclinic && !is_restricted(box)) {
    fmt::format_to(out, "ITEM: BOX BOUNDS abc origin{}\n", boundary_letters(box));
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 edge = box.vector(axis);
      fmt::format_to(out, "{} {} {} {}\n", edge.x, edge.y, edge.z, o[axis]);
    }
  } else if (box.kind() == Box::Kind::triclinic) {
    // Bounds are those of the bounding box (docs.lammps.org/Howto_triclinic.html).
    const double xy = b.x, xz = c.x, yz = c.y;
    fmt::format_to(out, "ITEM: BOX BOUNDS xy xz yz{}\n", boundary_letters(box));
    fmt::format_to(out, "{} {} {}\n", o.x + std::min({0.0, xy, xz, xy + xz}),
                   o.x + a.x + std::max({0.0, xy, xz, xy + xz}), xy);
    fmt::format_to(out, "{} {} {}\n", o.y + std::min(0.0, yz), o.y + b.y + std::max(0.0, yz), xz);
    fmt::format_to(out, "{} {} {}\n", o.z, o.z + c.z, yz);
  } else {
    fmt::format_to(out, "ITEM: BOX BOUNDS{}\n", boundary_letters(box));
    for (int axis = 0; axis < 3; ++axis) {
      fmt::format_to(out, "{} {}\n", o[axis], o[axis] + box.vector(axis)[axis]);
    }
  }
}

void LammpsDumpWriter::append_atoms(const Frame& frame) {
  const auto out = std::back_inserter(text_);
  const bool molecules = !frame.molecules.empty(), types = !frame.types.empty(),
             images = !frame.images.empty();
  fmt::format_to(out, "ITEM: ATOMS id{}{} x y z{}\n", molecules ? " mol" : "", types ? " type" : "",
                 images ? " ix iy iz" : "");
  for (std::size_t k = 0; k < frame.positions.size(); ++k) {
    fmt::format_to(out, "{}", frame.ids[k]);
    if (molecules) fmt::format_to(out, " {}", frame.molecules[k]);
    if (types) fmt::format_to(out, " {}", frame.types[k]);
    const Vec3 p = frame.positions[k];
    fmt::format_to(out, " {} {} {}", p.x, p.y, p.z);
    if (images) fmt::format_to(out, " {} {} {}", frame.images[k][0], frame.images[k][1], frame.images[k][2]);
    text_.push_back('\n');
    constexpr std::size_t kEnough = std::size_t{1} << 20;
    if (text_.size() > kEnough) flush();
  }
}

void LammpsDumpWriter::flush() {
  file_.write({text_.data(), text_.size()});
  text_.clear();
}

void LammpsDumpWriter::close() {
  if (std::exchange(closed_, true)) return;
  file_.commit();
}

}  // namespace dch::trajectory

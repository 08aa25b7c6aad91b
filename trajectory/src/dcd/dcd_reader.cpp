// SPDX-License-Identifier: MIT
#include "dcd/dcd_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>

#include "base/byte_order.hpp"
#include "frames/unit_cell.hpp"

namespace dch::trajectory {
namespace {

double degrees_of_cosine(double cosine) {
  return cosine == 0 ? 90 : std::acos(cosine) * 180 / std::numbers::pi;
}

/// The six numbers of the cell record, in the file's order: A, gamma, B, beta, alpha, C.
///
/// NAMD stores cosines, CHARMM up to version 21 degrees; later ones store the symmetric matrix xx, xy, yy,
/// xz, yz, zz. A matrix is recognized by an entry that cannot be an angle, as VMD and MDAnalysis do.
Cell interpret_cell(const std::array<double, 6>& u) {
  const std::array<double, 3> angles{u[1], u[3], u[4]};
  const auto all = [&](double low, double high) {
    return std::all_of(angles.begin(), angles.end(), [=](double a) { return a >= low && a <= high; });
  };
  const Vec3 lengths{u[0], u[2], u[5]};
  if (lengths == Vec3{}) return Cell{};
  if (all(-1, 1)) {
    return cell_from_angles(lengths, degrees_of_cosine(u[4]), degrees_of_cosine(u[3]),
                            degrees_of_cosine(u[1]));
  }
  if (all(0, 180)) return cell_from_angles(lengths, u[4], u[3], u[1]);
  Cell cell;
  cell.edges = {Vec3{u[0], u[1], u[3]}, Vec3{u[1], u[2], u[4]}, Vec3{u[3], u[4], u[5]}};
  return cell;
}

}  // namespace

DcdReader::DcdReader(const std::string& path)
    : file_(path), header_(read_dcd_header(file_)), records_(file_) {
  records_.set_order(header_.order);
  records_.skip_to(header_.size);
  if (records_.at_end()) records_.fail_here("the file ends behind its header: it holds no frame");
}

bool DcdReader::read(Frame& frame) {
  if (records_.at_end()) return false;
  records_.set_frame(frames_);
  if (frames_ > 0 && !header_.free_atoms.empty()) frame.positions = first_positions_;
  frame.box = Box::none();
  if (header_.has_cell) read_cell(frame);
  for (int axis = 0; axis < 3; ++axis) read_coordinate(axis, frame);
  if (header_.has_fourth_dimension) records_.next("the coordinates of the fourth dimension");
  if (frames_ == 0 && !header_.free_atoms.empty()) first_positions_ = frame.positions;

  frame.ids.resize(frame.positions.size());
  std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
  frame.types.clear();
  frame.molecules.clear();
  frame.images.clear();
  const bool has_steps = header_.step_interval > 0;
  frame.step = has_steps ? header_.first_step + frames_ * header_.step_interval : frames_;
  frame.time.reset();
  if (has_steps && std::isfinite(header_.time_step)) {
    frame.time = static_cast<double>(frame.step) * header_.time_step;
  }
  ++frames_;
  return true;
}

void DcdReader::read_cell(Frame& frame) {
  constexpr std::int64_t kSize = 6 * sizeof(double);
  const auto& data = records_.next("the unit cell", kSize);
  std::array<double, 6> numbers{};
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = decode<double>(data.data() + 8 * k, header_.order);
  try {
    frame.box = interpret_cell(numbers).box();
  } catch (const InvalidBox& error) {
    records_.fail_in_last(
        fmt::format("the unit cell (A {}, gamma {}, B {}, beta {}, alpha {}, C {}) is no cell: {}",
                    numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], error.what()));
  }
}

void DcdReader::read_coordinate(int axis, Frame& frame) {
  constexpr std::array<const char*, 3> kNames{"the x coordinates", "the y coordinates", "the z coordinates"};
  const bool only_free = frames_ > 0 && !header_.free_atoms.empty();
  const std::size_t count = only_free ? header_.free_atoms.size() : static_cast<std::size_t>(header_.atoms);
  const auto& data =
      records_.next(kNames[static_cast<std::size_t>(axis)], static_cast<std::int64_t>(4 * count));
  if (!only_free) frame.positions.resize(count);  // not before the file is known to hold that many
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t atom = only_free ? static_cast<std::size_t>(header_.free_atoms[k]) : k;
    const auto value = static_cast<double>(decode<float>(data.data() + 4 * k, header_.order));
    if (!is_valid_coordinate(value)) {
      records_.fail_in_last(fmt::format("the {} coordinate of atom {} is {}", "xyz"[axis], atom + 1, value));
    }
    frame.positions[atom][axis] = value;
  }
}

}  // namespace dch::trajectory

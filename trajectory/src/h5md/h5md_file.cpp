// SPDX-License-Identifier: MIT
#include "h5md/h5md_file.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "base/place.hpp"
#include "h5md/hdf5_attributes.hpp"

namespace dch::trajectory {
namespace {

Hdf5Handle create_group(hid_t parent, const char* name) {
  return Hdf5Handle(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

std::array<double, 9> matrix_of(const Box& box) {
  std::array<double, 9> matrix{};
  for (std::size_t k = 0; k < matrix.size(); ++k) {
    matrix[k] = box.vector(static_cast<int>(k / 3))[static_cast<int>(k % 3)];
  }
  return matrix;
}

Box::Periodic periodicity_of(const Box& box) { return {box.periodic(0), box.periodic(1), box.periodic(2)}; }

}  // namespace

H5mdFile::H5mdFile(const std::string& path, std::string name, std::string length_unit)
    : name_(std::move(name)), length_unit_(std::move(length_unit)) {
  const Hdf5Silence silence;
  file_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  check(file_.valid());
  create_metadata();
}

void H5mdFile::create_metadata() {
  const Hdf5Handle metadata = create_group(file_.get(), "h5md");
  check(metadata.valid() && write_attribute(metadata.get(), "version", std::vector<int>{1, 1}));
  const Hdf5Handle author = create_group(metadata.get(), "author");
  check(author.valid() && write_attribute(author.get(), "name", std::string("unknown")));
  const Hdf5Handle creator = create_group(metadata.get(), "creator");
  check(creator.valid() && write_attribute(creator.get(), "name", std::string("dchmd")) &&
        write_attribute(creator.get(), "version", std::string(DCH_VERSION)));

  const Hdf5Handle particles = create_group(file_.get(), "particles");
  group_ = create_group(particles.get(), "trajectory");
  box_ = create_group(group_.get(), "box");
  check(box_.valid() && write_attribute(box_.get(), "dimension", 3));
}

void H5mdFile::write(const Frame& frame) {
  const Hdf5Silence silence;
  if (frames_ == 0) {
    create_atoms(frame);
  } else {
    check_same_atoms(frame);
  }
  const double time = frame.time.value_or(std::numeric_limits<double>::quiet_NaN());
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  check(step_.write(frames_, H5T_NATIVE_INT64, &frame.step) &&
        time_.write(frames_, H5T_NATIVE_DOUBLE, &time) &&
        position_.write(frames_, H5T_NATIVE_DOUBLE, frame.positions.data()));
  if (image_.valid()) check(image_.write(frames_, H5T_NATIVE_INT32, frame.images.data()));
  write_box(frame.box);
  ++frames_;
}

void H5mdFile::create_atoms(const Frame& frame) {
  const hsize_t n = frame.positions.size();
  if (n == 0) fail_in_frame("H5MD has no place for frames without atoms");
  const Hdf5Handle position = create_group(group_.get(), "position");
  step_ = Hdf5Series(position.get(), "step", H5T_STD_I64LE, {});
  time_ = Hdf5Series(position.get(), "time", H5T_IEEE_F64LE, {});
  position_ = Hdf5Series(position.get(), "value", H5T_IEEE_F64LE, {n, 3});
  check(step_.valid() && time_.valid() && position_.valid());
  check(write_attribute(time_.get(), "unit", std::string("ps")));
  write_length_unit(position_.get());

  if (!frame.images.empty()) image_ = create_series("image", H5T_STD_I32LE, {n, 3});
  write_fixed("id", H5T_STD_I64LE, H5T_NATIVE_INT64, n, frame.ids.data());
  if (!frame.types.empty()) write_fixed("species", H5T_STD_I32LE, H5T_NATIVE_INT32, n, frame.types.data());
  if (!frame.molecules.empty())
    write_fixed("molecule", H5T_STD_I32LE, H5T_NATIVE_INT32, n, frame.molecules.data());
  first_.ids = frame.ids;
  first_.types = frame.types;
  first_.molecules = frame.molecules;
}

void H5mdFile::write_fixed(const char* name, hid_t file_type, hid_t memory_type, hsize_t count,
                           const void* values) {
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr));
  Hdf5Handle dataset(
      H5Dcreate2(group_.get(), name, file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  check(dataset.valid() && H5Dwrite(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  check(dataset.reset());
}

/// A time-dependent element that shares `step` and `time` with the positions.
Hdf5Series H5mdFile::create_series(const std::string& name, hid_t file_type,
                                   const std::vector<hsize_t>& row_shape) {
  const Hdf5Handle element = create_group(group_.get(), name.c_str());
  Hdf5Series series(element.get(), "value", file_type, row_shape);
  check(series.valid());
  for (const char* shared : {"step", "time"}) {
    const std::string from = std::string("position/") + shared;
    check(H5Lcreate_hard(group_.get(), from.c_str(), element.get(), shared, H5P_DEFAULT, H5P_DEFAULT) >= 0);
  }
  return series;
}

void H5mdFile::check_same_atoms(const Frame& frame) const {
  if (frame.ids != first_.ids)
    fail_in_frame("it has other atoms than the first frame, which H5MD has no place for");
  if (frame.types != first_.types) fail_in_frame("its types are not those of the first frame");
  if (frame.molecules != first_.molecules)
    fail_in_frame("its molecule numbers are not those of the first frame");
  if (frame.images.empty() == image_.valid()) fail_in_frame("image flags are there in some frames only");
}

void H5mdFile::write_box(const Box& box) {
  if (box.kind() == Box::Kind::none) return;
  if (!periodic_) {
    periodic_ = periodicity_of(box);
    edges_ = create_series("box/edges", H5T_IEEE_F64LE, {3, 3});
    write_length_unit(edges_.get());
  }
  if (*periodic_ != periodicity_of(box))
    fail_in_frame("the box is periodic along other axes than in the frames before");
  const std::array<double, 9> matrix = matrix_of(box);
  check(edges_.write(frames_, H5T_NATIVE_DOUBLE, matrix.data()));

  const Vec3 origin = box.origin();
  if (!offset_.valid() && origin != Vec3{}) {
    offset_ = create_series("box/offset", H5T_IEEE_F64LE, {3});
    write_length_unit(offset_.get());
  }
  if (offset_.valid()) check(offset_.write(frames_, H5T_NATIVE_DOUBLE, &origin));
}

/// MDAnalysis refuses files without a unit, or with one it does not know, and takes LAMMPS dumps, which say
/// nothing, for Angstrom. The attribute `source_unit` holds the truth; H5mdReader goes by it.
void H5mdFile::write_length_unit(hid_t value) const {
  constexpr std::array<const char*, 4> kKnown{"nm", "Angstrom", "pm", "fm"};
  const bool is_known = std::find(kKnown.begin(), kKnown.end(), length_unit_) != kKnown.end();
  check(write_attribute(value, "unit", is_known ? length_unit_ : std::string("Angstrom")));
  if (!is_known) check(write_attribute(value, "source_unit", length_unit_));
}

void H5mdFile::close() {
  if (!file_.valid()) return;
  const Hdf5Silence silence;
  if (frames_ == 0) fail(name_, "cannot be written: it would hold no frame");
  finish_box();
  bool good = H5Fflush(file_.get(), H5F_SCOPE_LOCAL) >= 0;
  for (Hdf5Series* series : {&step_, &time_, &position_, &image_, &edges_, &offset_})
    good = series->close() && good;
  for (Hdf5Handle* handle : {&box_, &group_, &file_}) good = handle->reset() && good;
  check(good);
}

void H5mdFile::finish_box() {
  if (edges_.valid()) check(edges_.grow(frames_));
  if (offset_.valid()) check(offset_.grow(frames_));
  std::vector<std::string> boundary;
  for (const bool is_periodic : periodic_.value_or(Box::Periodic{false, false, false})) {
    boundary.emplace_back(is_periodic ? "periodic" : "none");
  }
  check(write_attribute(box_.get(), "boundary", boundary));
}

void H5mdFile::check(bool good) const {
  if (!good) fail_in_frame(hdf5_reason());
}

void H5mdFile::fail_in_frame(const std::string& what) const {
  fail(name_, fmt::format("frame {} cannot be written: {}", frames_, what));
}

}  // namespace dch::trajectory

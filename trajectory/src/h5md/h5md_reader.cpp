// SPDX-License-Identifier: MIT
#include "h5md/h5md_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include "base/place.hpp"
#include "frames/cell.hpp"
#include "h5md/hdf5_open.hpp"
#include "process/forked_reader.hpp"

namespace dch::trajectory {
namespace {

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

/// Deflate packs a byte of zeros into 1/1032 byte at best, so that a file claiming more is broken (or all
/// fill values, which is no trajectory either); without this check it would ask for any amount of memory.
constexpr std::int64_t kBestCompression = 1032;

/// Bytes that the positions of a frame may take as doubles: a file that is not compressed may hold them as
/// bytes of one eighth, a compressed one has the limit.
std::int64_t most_position_bytes(std::int64_t file_size, const ReadLimits& limits) {
  constexpr std::int64_t kWidest = sizeof(double);
  return std::min(std::max(kWidest * file_size, limits.expanded), 2 * kBestCompression * file_size);
}

double picoseconds(const std::string& unit) {
  constexpr std::pair<const char*, double> kUnits[] = {
      {"fs", 1e-3}, {"ns", 1e3}, {"us", 1e6}, {"s", 1e12}, {"AKMA", 0.0488882129}};
  for (const auto& [name, value] : kUnits) {
    if (unit == name) return value;
  }
  return 1;
}

}  // namespace

H5mdReader::H5mdReader(std::shared_ptr<const InputFile> input, const ReadLimits& limits)
    : input_(std::move(input)), path_(input_->path()), file_(open_hdf5(*input_)) {
  if (!file_.valid()) fail(path_, "is not a readable HDF5 file: it is truncated or broken; " + hdf5_reason());
  open_group();
  position_ = find("position");
  check_positions();
  check_size(limits);
  image_ = find_per_atom("image", 3);
  id_ = find_per_atom("id", 1);
  species_ = find_per_atom("species", 1);
  molecule_ = find_per_atom("molecule", 1);
  open_box();
  length_unit_ = position_->value_attribute("source_unit")
                     .value_or(position_->value_attribute("unit").value_or("the file's unit"));
}

void H5mdReader::open_group() {
  const Hdf5Lead lead = hdf5_lead(file_.get(), "particles");
  if (lead == Hdf5Lead::outside) fail(path_, "'particles' is a link to another file, which is not read");
  if (lead == Hdf5Lead::nowhere) fail(path_, "has no group 'particles': it is not an H5MD trajectory");
  const Hdf5Handle particles(H5Gopen2(file_.get(), "particles", H5P_DEFAULT));
  if (!particles.valid()) fail(path_, "'particles' cannot be opened; " + hdf5_reason());
  group_name_ = choose_group(particles.get());
  group_ = Hdf5Handle(H5Gopen2(particles.get(), group_name_.c_str(), H5P_DEFAULT));
  if (!group_.valid())
    fail(path_, fmt::format("'particles/{}' cannot be opened; {}", group_name_, hdf5_reason()));
}

std::string H5mdReader::choose_group(hid_t particles) const {
  std::vector<std::string> names;
  for (const std::string& name : names_in(particles)) {
    const Hdf5Lead lead = hdf5_lead(particles, name + "/position");
    if (lead == Hdf5Lead::outside) {
      fail(path_, fmt::format("'particles/{}/position' leads to another file, which is not read", name));
    }
    if (lead == Hdf5Lead::object) names.push_back(name);
  }
  if (names.empty()) fail(path_, "no group in 'particles' has positions");
  if (names.size() == 1) return names.front();
  for (const char* usual : {"trajectory", "all"}) {
    if (std::find(names.begin(), names.end(), usual) != names.end()) return usual;
  }
  fail(path_, fmt::format(
                  "'particles' has {} groups with positions ({}, {}, ...), none called 'trajectory' or 'all'",
                  names.size(), names[0], names[1]));
}

std::optional<H5mdElement> H5mdReader::find(const std::string& name) const {
  return H5mdElement::find(group_.get(), name, fmt::format("{}: /particles/{}/{}", path_, group_name_, name));
}

std::optional<H5mdElement> H5mdReader::find_per_atom(const std::string& name, std::size_t components) const {
  auto element = find(name);
  if (!element) return element;
  std::vector<hsize_t> expected{position_->shape()[0]};
  if (components > 1) expected.push_back(components);
  if (element->shape() != expected) {
    element->fail_here(
        fmt::format("does not have {} numbers for each of the {} atoms", components, expected[0]));
  }
  if (!element->is_fixed() && element->frames() != position_->frames()) {
    element->fail_here(fmt::format("has {} frames, position has {}", element->frames(), position_->frames()));
  }
  return element;
}

void H5mdReader::check_positions() const {
  const auto& shape = position_->shape();
  if (shape.size() != 2 || shape[1] != 3)
    position_->fail_here("does not have three coordinates for each atom");
  constexpr hsize_t kMaxAtoms = 2147483647;
  if (shape[0] > kMaxAtoms)
    position_->fail_here(fmt::format("has {} atoms, more than {}", shape[0], kMaxAtoms));
  if (position_->frames() == 0) position_->fail_here("holds no frame");
}

void H5mdReader::check_size(const ReadLimits& limits) const {
  const std::int64_t atoms = static_cast<std::int64_t>(position_->shape()[0]), size = input_->size();
  const std::int64_t bytes = atoms * 3 * static_cast<std::int64_t>(sizeof(double));
  if (bytes > 2 * kBestCompression * size) {
    position_->fail_here(
        fmt::format("claims {} atoms, more than the file of {} bytes can hold", atoms, size));
  }
  if (bytes > most_position_bytes(size, limits)) {
    position_->fail_here(fmt::format(
        "a frame of {} atoms expands to {} bytes, more than {}: if the file is sound, raise the limit "
        "with --max-expanded",
        atoms, bytes, limits.expanded));
  }
}

void H5mdReader::open_box() {
  const Hdf5Lead lead = hdf5_lead(group_.get(), "box");
  if (lead == Hdf5Lead::outside) {
    fail(path_, fmt::format("'particles/{}/box' is a link to another file, which is not read", group_name_));
  }
  if (lead == Hdf5Lead::nowhere) return;
  const Hdf5Handle box(H5Gopen2(group_.get(), "box", H5P_DEFAULT));
  if (!box.valid())
    fail(path_, fmt::format("'particles/{}/box' cannot be opened; {}", group_name_, hdf5_reason()));
  const std::vector<std::string> boundary = read_string_attribute(box.get(), "boundary");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string* word = boundary.size() == 3   ? &boundary[axis]
                              : boundary.size() == 1 ? &boundary.front()
                                                     : nullptr;
    if (word == nullptr || (*word != "periodic" && *word != "none")) {
      fail(path_, fmt::format(
                      "/particles/{}/box: expected the attribute 'boundary' with three of 'periodic', 'none'",
                      group_name_));
    }
    periodic_[axis] = *word == "periodic";
  }
  edges_ = find("box/edges");
  offset_ = find("box/offset");
  const bool any_periodic = periodic_[0] || periodic_[1] || periodic_[2];
  if (any_periodic && !edges_)
    fail(path_, fmt::format("/particles/{}/box: is periodic but has no 'edges'", group_name_));
  for (const auto* element : {&edges_, &offset_}) {
    if (!*element) continue;
    const auto& shape = (*element)->shape();
    const bool is_vector = shape == std::vector<hsize_t>{3}, is_matrix = shape == std::vector<hsize_t>{3, 3};
    if (!is_vector && !(is_matrix && element == &edges_))
      (*element)->fail_here("has not three numbers, or three by three");
    if (!(*element)->is_fixed() && (*element)->frames() != position_->frames()) {
      (*element)->fail_here(
          fmt::format("has {} frames, position has {}", (*element)->frames(), position_->frames()));
    }
  }
}

bool H5mdReader::read(Frame& frame) {
  if (frames_ == position_->frames()) return false;
  frame.step = position_->is_fixed() ? 0 : position_->step(frames_);
  frame.time = read_time(frames_);
  frame.box = read_box(frames_);
  read_positions(frame);
  frame.types.clear();
  if (species_) species_->read(frames_, frame.types);
  frame.molecules.clear();
  if (molecule_) molecule_->read(frames_, frame.molecules);
  read_images(frame);
  read_ids(frame);
  ++frames_;
  return true;
}

std::optional<double> H5mdReader::read_time(std::int64_t frame) const {
  if (position_->is_fixed() || !position_->has_time()) return std::nullopt;
  const double time = position_->time(frame);
  if (!std::isfinite(time)) return std::nullopt;
  return time * picoseconds(position_->time_attribute("unit").value_or("ps"));
}

Box H5mdReader::read_box(std::int64_t frame) const {
  if (!edges_) return Box::none();
  Cell cell;
  cell.periodic = periodic_;
  std::vector<double> numbers;
  edges_->read(frame, numbers);
  for (std::size_t row = 0; row < 3; ++row) {
    const int axis = static_cast<int>(row);
    if (numbers.size() == 3) {
      cell.edges[row][axis] = numbers[row];
    } else {
      cell.edges[row] = {numbers[3 * row], numbers[3 * row + 1], numbers[3 * row + 2]};
    }
  }
  if (cell.is_zero()) return Box::none();
  if (offset_) {
    offset_->read(frame, numbers);
    cell.origin = {numbers[0], numbers[1], numbers[2]};
  }
  try {
    return cell.box();
  } catch (const InvalidBox& error) {
    fail_in_frame(fmt::format("/particles/{}/box/edges: {}", group_name_, error.what()));
  }
}

void H5mdReader::read_positions(Frame& frame) {
  position_->read(frames_, numbers_);
  frame.positions.resize(numbers_.size() / 3);
  for (std::size_t k = 0; k < frame.positions.size(); ++k) {
    frame.positions[k] = {numbers_[3 * k], numbers_[3 * k + 1], numbers_[3 * k + 2]};
    if (is_valid_position(frame.positions[k])) continue;
    const Vec3 bad = frame.positions[k];
    fail_in_frame(fmt::format("/particles/{}/position: atom {} has a coordinate that is not finite: {} {} {}",
                              group_name_, k, bad.x, bad.y, bad.z));
  }
}

void H5mdReader::read_images(Frame& frame) {
  frame.images.clear();
  if (!image_) return;
  image_->read(frames_, integers_);
  frame.images.resize(integers_.size() / 3);
  for (std::size_t k = 0; k < frame.images.size(); ++k) {
    frame.images[k] = {integers_[3 * k], integers_[3 * k + 1], integers_[3 * k + 2]};
  }
}

void H5mdReader::read_ids(Frame& frame) {
  if (!id_) {
    frame.ids.resize(frame.positions.size());
    std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
    return;
  }
  id_->read(frames_, frame.ids);
  if (const auto repeated = sorter_.sort_by_id(frame)) {
    fail_in_frame(fmt::format("/particles/{}/id: the id {} appears twice, at {} and {}", group_name_,
                              repeated->id, repeated->first, repeated->second));
  }
}

void H5mdReader::fail_in_frame(const std::string& what) const {
  fail(path_, fmt::format("frame {}, {}", frames_, what));
}

std::unique_ptr<TrajectoryReader> make_h5md_reader(const std::string& path, const ReadLimits& limits) {
  const auto input = std::make_shared<const InputFile>(path);
  // HDF5 and its caches; then the positions as the file has them, as doubles, in the frame, and the rest of
  // it.
  constexpr std::int64_t kForLibrary = std::int64_t{1} << 30, kCopies = 6;
  ChildBounds bounds;
  bounds.rights =
      ChildRights{{input->descriptor()}, kForLibrary + kCopies * most_position_bytes(input->size(), limits)};
  constexpr std::int64_t kSlowest = 10'000'000, kLongest = 3600;  // [bytes/s], [s]
  bounds.seconds_per_frame = 20 + static_cast<int>(std::min(input->size() / kSlowest, kLongest));
  return std::make_unique<ForkedReader>(
      path, [=] { return std::make_unique<H5mdReader>(input, limits); }, bounds);
}

}  // namespace dch::trajectory

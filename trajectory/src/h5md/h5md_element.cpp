// SPDX-License-Identifier: MIT
#include "h5md/h5md_element.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "h5md/hdf5_open.hpp"

namespace dch::trajectory {
namespace {

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
}

std::vector<hsize_t> dimensions_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset));
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.get()) : -1;
  if (rank < 0) return {};
  std::vector<hsize_t> dimensions(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), dimensions.data(), nullptr);
  return dimensions;
}

bool is_number(hid_t dataset) {
  const Hdf5Handle type(H5Dget_type(dataset));
  const H5T_class_t kind = type.valid() ? H5Tget_class(type.get()) : H5T_NO_CLASS;
  return kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
}

}  // namespace

std::optional<H5mdElement> H5mdElement::find(hid_t group, const std::string& name, const std::string& place) {
  H5mdElement element;
  element.place_ = place;
  const Hdf5Lead lead = hdf5_lead(group, name);
  if (lead == Hdf5Lead::outside) element.fail_here("is a link to another file, which is not read");
  if (lead == Hdf5Lead::nowhere) return std::nullopt;
  H5O_info_t info{};
  if (H5Oget_info_by_name2(group, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
    element.fail_here(hdf5_reason());
  }
  if (info.type == H5O_TYPE_GROUP) {
    element.open_group(group, name);
  } else if (info.type == H5O_TYPE_DATASET) {
    element.open_fixed(group, name);
  } else {
    element.fail_here("is neither a dataset nor a group");
  }
  element.read_shape();
  return element;
}

void H5mdElement::open_fixed(hid_t group, const std::string& name) {
  value_ = Hdf5Handle(H5Dopen2(group, name.c_str(), H5P_DEFAULT));
  if (!value_.valid()) fail_here("cannot be opened; " + hdf5_reason());
  refuse_outside(value_, name.c_str());
}

void H5mdElement::refuse_outside(const Hdf5Handle& dataset, const char* part) const {
  const std::string way = hdf5_outside(dataset.get());
  if (!way.empty())
    fail_here(fmt::format("'{}' {}, which are not read; copy the file with h5repack", part, way));
}

void H5mdElement::open_group(hid_t parent, const std::string& name) {
  is_fixed_ = false;
  const Hdf5Handle group(H5Gopen2(parent, name.c_str(), H5P_DEFAULT));
  if (!group.valid()) fail_here("cannot be opened; " + hdf5_reason());
  const auto open = [&](const char* part) {
    const Hdf5Lead lead = hdf5_lead(group.get(), part);
    if (lead == Hdf5Lead::outside) {
      fail_here(fmt::format("its '{}' is a link to another file, which is not read", part));
    }
    if (lead == Hdf5Lead::nowhere) return Hdf5Handle();
    Hdf5Handle dataset(H5Dopen2(group.get(), part, H5P_DEFAULT));
    if (!dataset.valid()) fail_here(fmt::format("its '{}' cannot be opened; {}", part, hdf5_reason()));
    refuse_outside(dataset, part);
    return dataset;
  };
  value_ = open("value");
  step_ = open("step");
  time_ = open("time");
  if (!value_.valid()) fail_here("has no dataset 'value'");
}

void H5mdElement::read_shape() {
  if (!is_number(value_.get())) fail_here("does not hold numbers");
  shape_ = dimensions_of(value_.get());
  if (is_fixed_) return;
  if (shape_.empty()) fail_here("its 'value' has no dimension for the frames");
  if (shape_.front() > static_cast<hsize_t>(std::numeric_limits<std::int64_t>::max()))
    fail_here("has too many frames");
  frames_ = static_cast<std::int64_t>(shape_.front());
  shape_.erase(shape_.begin());
}

std::size_t H5mdElement::count() const {
  return static_cast<std::size_t>(
      std::accumulate(shape_.begin(), shape_.end(), hsize_t{1}, std::multiplies<>()));
}

template <class T>
void H5mdElement::read(std::int64_t frame, std::vector<T>& values) const {
  values.resize(count());
  read_raw(frame, native_type<T>(), values.data());
}
template void H5mdElement::read(std::int64_t, std::vector<double>&) const;
template void H5mdElement::read(std::int64_t, std::vector<std::int64_t>&) const;
template void H5mdElement::read(std::int64_t, std::vector<std::int32_t>&) const;

void H5mdElement::read_raw(std::int64_t frame, hid_t type, void* values) const {
  if (count() == 0) return;
  if (is_fixed_) {
    if (H5Dread(value_.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
      fail_here("cannot be read; " + hdf5_reason());
    }
    return;
  }
  std::vector<hsize_t> start(shape_.size() + 1, 0), size(shape_);
  start[0] = static_cast<hsize_t>(frame);
  size.insert(size.begin(), 1);
  const Hdf5Handle file_space(H5Dget_space(value_.get()));
  const Hdf5Handle memory_space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr));
  if (H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) <
          0 ||
      H5Dread(value_.get(), type, memory_space.get(), file_space.get(), H5P_DEFAULT, values) < 0) {
    fail_here(fmt::format("frame {} cannot be read; {}", frame, hdf5_reason()));
  }
}

/// `step` and `time` are one number a frame, or a single one, the increment, with the first in the attribute
/// `offset`.
template <class T>
T H5mdElement::read_series(const Hdf5Handle& series, const char* what, std::int64_t frame) const {
  const std::vector<hsize_t> dimensions = dimensions_of(series.get());
  T value{};
  if (dimensions.empty()) {
    T offset{};
    const htri_t has_offset = H5Aexists(series.get(), "offset");
    if (has_offset < 0) fail_here(std::string("its offset of ") + what + " cannot be read");
    if (has_offset > 0) {
      const Hdf5Handle attribute(H5Aopen(series.get(), "offset", H5P_DEFAULT));
      if (H5Aread(attribute.get(), native_type<T>(), &offset) < 0)
        fail_here(std::string("its offset of ") + what + " cannot be read");
    }
    if (H5Dread(series.get(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &value) < 0) {
      fail_here(fmt::format("its {} cannot be read; {}", what, hdf5_reason()));
    }
    return static_cast<T>(offset + static_cast<T>(frame) * value);
  }
  if (dimensions.size() != 1 || dimensions[0] <= static_cast<hsize_t>(frame)) {
    fail_here(fmt::format("has {} frames of values but its '{}' ends before frame {}", frames_, what, frame));
  }
  const hsize_t start = static_cast<hsize_t>(frame), one = 1;
  const Hdf5Handle file_space(H5Dget_space(series.get()));
  const Hdf5Handle memory_space(H5Screate_simple(1, &one, nullptr));
  if (H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, &start, nullptr, &one, nullptr) < 0 ||
      H5Dread(series.get(), native_type<T>(), memory_space.get(), file_space.get(), H5P_DEFAULT, &value) <
          0) {
    fail_here(fmt::format("its {} of frame {} cannot be read; {}", what, frame, hdf5_reason()));
  }
  return value;
}

std::int64_t H5mdElement::step(std::int64_t frame) const {
  return step_.valid() ? read_series<std::int64_t>(step_, "step", frame) : frame;
}

double H5mdElement::time(std::int64_t frame) const { return read_series<double>(time_, "time", frame); }

std::optional<std::string> H5mdElement::value_attribute(const std::string& name) const {
  const auto strings = read_string_attribute(value_.get(), name);
  return strings.size() == 1 ? std::optional(strings.front()) : std::nullopt;
}

std::optional<std::string> H5mdElement::time_attribute(const std::string& name) const {
  if (!time_.valid()) return std::nullopt;
  const auto strings = read_string_attribute(time_.get(), name);
  return strings.size() == 1 ? std::optional(strings.front()) : std::nullopt;
}

void H5mdElement::fail_here(const std::string& what) const { throw FileError(place_ + ": " + what); }

std::vector<std::string> read_string_attribute(hid_t object, const std::string& name) {
  const std::string here = "the attribute '" + name + "'";
  const htri_t exists = H5Aexists(object, name.c_str());
  hdf5_require(exists >= 0, here);
  if (exists == 0) return {};
  const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT));
  hdf5_require(attribute.valid(), here);
  const Hdf5Handle type(H5Aget_type(attribute.get()));
  const Hdf5Handle space(H5Aget_space(attribute.get()));
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  constexpr hssize_t kMax = 16;  // three boundaries, or one unit
  if (H5Tget_class(type.get()) != H5T_STRING || count < 1 || count > kMax) return {};

  std::vector<std::string> strings;
  if (H5Tis_variable_str(type.get()) > 0) {
    std::vector<char*> raw(static_cast<std::size_t>(count), nullptr);
    hdf5_require(H5Aread(attribute.get(), type.get(), raw.data()) >= 0, here);
    for (char* text : raw) strings.emplace_back(text != nullptr ? text : "");
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, raw.data());
    return strings;
  }
  const std::size_t length = H5Tget_size(type.get());
  constexpr std::size_t kLongest = 4096;
  if (length > kLongest) return {};
  std::string raw(length * static_cast<std::size_t>(count), '\0');
  hdf5_require(H5Aread(attribute.get(), type.get(), raw.data()) >= 0, here);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    std::string text = raw.substr(k * length, length);
    text.resize(std::min(text.find('\0'), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    strings.push_back(std::move(text));
  }
  return strings;
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "h5md/hdf5_handle.hpp"

namespace dch::trajectory {

/// An H5MD element: a dataset (the same in all frames), or a group of `value`, `step` and perhaps `time`,
/// where `value` has one more dimension, the frames (nongnu.org/h5md/h5md.html, "Time-dependent data").
class H5mdElement {
 public:
  /// The element `name` of a group, if it is there.
  /// @param place path of the file and of the element inside it, for messages
  /// @throws FileError if the object is neither.
  static std::optional<H5mdElement> find(hid_t group, const std::string& name, const std::string& place);

  bool is_fixed() const { return is_fixed_; }
  /// Frames of a time-dependent element; 1 for a fixed one.
  std::int64_t frames() const { return frames_; }
  /// Dimensions of one frame's value.
  const std::vector<hsize_t>& shape() const { return shape_; }
  bool has_time() const { return time_.valid(); }

  /// Reads one frame's value (frame is ignored if is_fixed()). @throws FileError.
  template <class T>
  void read(std::int64_t frame, std::vector<T>& values) const;

  /// @throws FileError if there is no such number in the file.
  std::int64_t step(std::int64_t frame) const;
  double time(std::int64_t frame) const;

  /// A string attribute of the value, or of the time.
  std::optional<std::string> value_attribute(const std::string& name) const;
  std::optional<std::string> time_attribute(const std::string& name) const;

  [[noreturn]] void fail_here(const std::string& what) const;

 private:
  void open_fixed(hid_t group, const std::string& name);
  void open_group(hid_t parent, const std::string& name);
  void refuse_outside(const Hdf5Handle& dataset, const char* part) const;
  void read_shape();
  void read_raw(std::int64_t frame, hid_t type, void* values) const;
  template <class T>
  T read_series(const Hdf5Handle& series, const char* what, std::int64_t frame) const;
  std::size_t count() const;

  std::string place_;
  bool is_fixed_ = true;
  std::int64_t frames_ = 1;
  std::vector<hsize_t> shape_;
  Hdf5Handle value_;
  Hdf5Handle step_;
  Hdf5Handle time_;
};

/// The string attribute `name` of an object, or all strings of an array of them. Empty if there is none.
std::vector<std::string> read_string_attribute(hid_t object, const std::string& name);

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <hdf5.h>
#include <map>
#include <string>
#include <utility>

#include "report/hdf5_file.hpp"

namespace dch::cli {

/// An HDF5 identifier with the function that closes it.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  /// @throws trajectory::FileError for the identifier of a failure.
  Hdf5Id(hid_t id, Close close);
  ~Hdf5Id() { reset(); }
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  operator hid_t() const { return id_; }
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// What an Hdf5File's child does with HDF5; see there. All functions throw trajectory::FileError, which names
/// the remedy and not the file.
class Hdf5Output {
 public:
  /// Replaces the file.
  explicit Hdf5Output(const std::string& path);

  void create_group(const std::string& name);
  void write_attribute(const std::string& name, const std::string& value);
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);
  void create_dataset(const std::string& name, Hdf5Type type, std::int64_t columns, std::int64_t chunk_rows);
  void append(const std::string& name, Hdf5Type memory_type, std::int64_t rows, std::int64_t columns,
              const void* values);
  /// HDF5 writes much of what it was given only now.
  void close();

 private:
  Hdf5Id file_;
  std::map<std::string, Hdf5Id> datasets_;
};

}  // namespace dch::cli

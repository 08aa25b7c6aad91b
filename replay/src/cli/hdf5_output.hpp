// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <hdf5.h>
#include <string>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "output_file.hpp"

namespace dch::cli {

/// Turns HDF5's own messages off: ours name file and remedy.
void silence_hdf5();

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
  /// HDF5 writes much of what it was given only now.
  /// @throws trajectory::FileError if that fails, of which the destructor would say nothing.
  void finish();
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// An HDF5 file under an output's temporary name.
Hdf5Id create_hdf5(const OutputFile& output);
Hdf5Id create_group(hid_t parent, const char* name);

void write_attribute(hid_t object, const char* name, const std::string& value);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, std::int64_t value);

/// Entries a chunk: of 4 or 8 bytes about a megabyte, the size that HDF5 caches by default.
constexpr hsize_t kChunkEntries = 1 << 18;

/// A compressed dataset that grows along its first axis; `columns` is 0 for one of a single axis.
Hdf5Id create_growing(hid_t parent, const char* name, hid_t type, hsize_t columns, hsize_t chunk_rows);

/// Appends `rows` rows; `columns` as in create_growing.
/// @throws trajectory::FileError
void append_rows(hid_t data, hid_t memory_type, hsize_t rows, hsize_t columns, const void* values);

/// Names the file in errors of the HDF5 layer above.
template <class Action>
auto named(const OutputFile& file, Action action) {
  try {
    return action();
  } catch (const trajectory::FileError& error) {
    throw trajectory::FileError(file.path() + ": " + error.what() +
                                "; check the free space and the folder's permissions");
  }
}

}  // namespace dch::cli

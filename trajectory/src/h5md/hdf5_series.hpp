// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "h5md/hdf5_handle.hpp"

namespace dch::trajectory {

/// A dataset that grows by one row (a number, a vector, a matrix, ...) a frame. Rows never written are zeros.
class Hdf5Series {
 public:
  Hdf5Series() = default;
  /// Creates it; check valid().
  Hdf5Series(hid_t parent, const std::string& name, hid_t file_type, const std::vector<hsize_t>& row_shape);

  bool valid() const { return dataset_.valid(); }
  hid_t get() const { return dataset_.get(); }

  /// Writes row k, growing to k + 1 rows if there are fewer. False if HDF5 fails.
  bool write(std::int64_t k, hid_t memory_type, const void* row);
  /// Grows to that many rows. False if HDF5 fails.
  bool grow(std::int64_t rows);
  bool close() { return dataset_.reset(); }

 private:
  std::vector<hsize_t> row_shape_;
  std::int64_t rows_ = 0;
  Hdf5Handle dataset_;
};

}  // namespace dch::trajectory

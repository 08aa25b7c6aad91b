// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <dch/trajectory/frame.hpp>

#include "h5md/hdf5_handle.hpp"
#include "h5md/hdf5_series.hpp"

namespace dch::trajectory {

/// An H5MD 1.1 file being written, such that MDAnalysis opens it, which asks for more than the format: the
/// group of particles is called `trajectory`, `time` is there (NaN for frames without one), the box is a
/// matrix a frame, and units are of its list.
///
/// Ids, types and molecules are fixed elements, so a frame with other ones cannot be written. A frame without
/// a box among others with one gets a matrix of zeros.
class H5mdFile {
 public:
  /// @param path where to write
  /// @param name what messages call the file
  /// @throws FileError, as all functions.
  H5mdFile(const std::string& path, std::string name, std::string length_unit);

  void write(const Frame& frame);
  void close();

 private:
  void create_metadata();
  void create_atoms(const Frame& frame);
  void write_fixed(const char* name, hid_t file_type, hid_t memory_type, hsize_t count, const void* values);
  Hdf5Series create_series(const std::string& name, hid_t file_type, const std::vector<hsize_t>& row_shape);
  void check_same_atoms(const Frame& frame) const;
  void write_box(const Box& box);
  void write_length_unit(hid_t value) const;
  void finish_box();
  void check(bool good) const;
  [[noreturn]] void fail_in_frame(const std::string& what) const;

  std::string name_;
  std::string length_unit_;
  Hdf5Handle file_, group_, box_;
  Hdf5Series step_, time_, position_, image_, edges_, offset_;
  std::optional<Box::Periodic> periodic_;  ///< of the first frame that has a box
  Frame first_;                            ///< ids, types, molecules of the first frame
  std::int64_t frames_ = 0;
};

}  // namespace dch::trajectory

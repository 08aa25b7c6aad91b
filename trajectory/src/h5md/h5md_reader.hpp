// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "files/input_file.hpp"
#include "frames/frame_sorter.hpp"
#include "h5md/h5md_element.hpp"
#include "h5md/hdf5_handle.hpp"

namespace dch::trajectory {

/// H5MD files (P. de Buyl, P. H. Colberg, F. Hoefling, Comput. Phys. Commun. 185:1546, 2014): position, box,
/// id, species, image of one group of particles, and the elements `molecule` and `box/offset` that H5mdWriter
/// adds.
///
/// Use it in a child process without rights (make_h5md_reader does): HDF5 does not stand every broken file.
class H5mdReader final : public TrajectoryReader {
 public:
  H5mdReader(std::shared_ptr<const InputFile> input, const ReadLimits& limits);

  bool read(Frame& frame) override;
  std::string format() const override { return "H5MD"; }
  std::string length_unit() const override { return length_unit_; }

 private:
  void open_group();
  std::string choose_group(hid_t particles) const;
  void open_box();
  std::optional<H5mdElement> find(const std::string& name) const;
  std::optional<H5mdElement> find_per_atom(const std::string& name, std::size_t components) const;
  void check_positions() const;
  void check_size(const ReadLimits& limits) const;
  Box read_box(std::int64_t frame) const;
  void read_positions(Frame& frame);
  void read_ids(Frame& frame);
  void read_images(Frame& frame);
  std::optional<double> read_time(std::int64_t frame) const;
  [[noreturn]] void fail_in_frame(const std::string& what) const;

  std::shared_ptr<const InputFile> input_;
  std::string path_;
  std::string group_name_;
  std::string length_unit_;
  Hdf5Silence silence_;
  Hdf5Handle file_;
  Hdf5Handle group_;
  std::optional<H5mdElement> position_, image_, id_, species_, molecule_, edges_, offset_;
  Box::Periodic periodic_{false, false, false};
  std::int64_t frames_ = 0;
  FrameSorter sorter_;
  std::vector<double> numbers_;         ///< scratch
  std::vector<std::int32_t> integers_;  ///< scratch
};

/// An H5mdReader in a child process that has given up its rights.
/// @throws FileError as open_trajectory.
std::unique_ptr<TrajectoryReader> make_h5md_reader(const std::string& path, const ReadLimits& limits);

}  // namespace dch::trajectory

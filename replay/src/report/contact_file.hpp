// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/necklace/contact_events.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contact_probability.hpp>
#include <dch/necklace/necklace.hpp>

#include "report/contact_report.hpp"
#include "report/hdf5_file.hpp"

namespace dch::cli {

/// What a file of contacts says about itself.
struct ContactFileHeader {
  std::string source, topology;  ///< the trajectory's name, and where the chains came from
  std::string unit;              ///< of lengths
  std::string time;              ///< what events are timed by: "time" or "step"
  necklace::ContactQuery query;
};

/// Writes contacts to an HDF5 file: events as they end, so that only those of the frame at hand are held in
/// memory, and the sums at the end. docs/formats.md describes the file.
class ContactFile {
 public:
  /// @param ids of the necklace's particles
  /// @throws trajectory::FileError if the file cannot be created.
  ContactFile(const std::string& path, const ContactFileHeader& header, const necklace::Necklace& necklace,
              const std::vector<std::int64_t>& ids);

  /// @throws trajectory::FileError, the disk being full, say.
  void append(const ContactFrame& frame);
  void append(Span<const necklace::ContactEvent> events);

  /// Writes the sums, completes the file and gives it its name. @throws trajectory::FileError.
  void finish(const necklace::ContactMap& map, const necklace::ContactProbability& probability);

 private:
  Hdf5File file_;
  std::vector<std::int64_t> ids_;
};

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "report/output_file.hpp"

namespace dch::trajectory {
class ChildProcess;
}

namespace dch::cli {

enum class Hdf5Type : int { int8, int32, int64, float64 };

/// Entries a chunk: of 4 or 8 bytes about a megabyte, the size that HDF5 caches by default.
constexpr std::int64_t kChunkEntries = 1 << 18;

/// An HDF5 file that a child process writes. Where memory or disk run out, HDF5 may end the process or reach
/// beyond its memory; there that is an error like others. Groups and datasets are named by their paths; all
/// functions throw trajectory::FileError, which names the file.
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void create_group(const std::string& name);
  /// Attributes of the whole file.
  void write_attribute(const std::string& name, const std::string& value);
  void write_attribute(const std::string& name, double value);
  void write_attribute(const std::string& name, std::int64_t value);
  /// A compressed dataset that grows along its first axis.
  /// @param columns 0 for one of a single axis
  /// @param chunk_rows rows that are compressed together
  void create_dataset(const std::string& name, Hdf5Type type, std::int64_t columns, std::int64_t chunk_rows);
  /// Appends whole rows, whose number follows from that of the values.
  void append(const std::string& name, std::int64_t columns, const std::vector<std::int64_t>& values);
  void append(const std::string& name, std::int64_t columns, const std::vector<std::int32_t>& values);
  void append(const std::string& name, std::int64_t columns, const std::vector<double>& values);
  /// Completes the file and gives it its name.
  void commit();

 private:
  struct Request;
  template <class Value>
  void append_values(const std::string& name, std::int64_t columns, Hdf5Type type,
                     const std::vector<Value>& values);
  void send(Request request, const std::string& name, const void* data);
  static bool answer_one(int socket, class Hdf5Output& output);
  static void answer_all(int socket, const std::string& path);
  [[noreturn]] void fail(const std::string& what) const;

  OutputFile file_;
  std::unique_ptr<trajectory::ChildProcess> child_;
};

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "options/option_values.hpp"

namespace dch::cli {

class Command;

/// A trajectory as the command line names it.
struct InputWords {
  std::string file, format, max_expanded;

  /// For require_distinct_files(); standard input is no file.
  NamedPath named(const std::string& argument) const { return {argument, file == "-" ? "" : file}; }
};

/// Declares the argument, --format and --max-expanded. @param help what the argument is, for the help text.
void add_input_options(Command& command, InputWords& words, const std::string& argument,
                       const std::string& help);

/// A trajectory that can be opened as often as need be. Standard input and named pipes, which can be read
/// once only, are copied to a nameless file in the folder for temporary files first, to their end; so they
/// are checked before any work is done, as files are, and no kind of file needs a reader of its own for them.
class TrajectoryInput {
 public:
  TrajectoryInput() = default;
  /// @throws UsageError if the format is unknown, not given to standard input, or H5MD from a pipe;
  ///   trajectory::FileError if a name tells no format, a pipe cannot be read or its copy not written.
  explicit TrajectoryInput(const InputWords& words);

  /// For messages and reports.
  const std::string& name() const { return name_; }
  /// Those of this file and of what belongs to it, such as its topology.
  const trajectory::ReadLimits& limits() const { return limits_; }
  /// @throws trajectory::FileError as trajectory::open_trajectory, under that name; so does the reader.
  std::unique_ptr<trajectory::TrajectoryReader> open() const;

 private:
  void require_format_of_pipes() const;
  void copy(int descriptor);

  std::string name_, path_, format_;
  trajectory::ReadLimits limits_;
  std::shared_ptr<const int> copy_;  ///< the nameless file, open
};

}  // namespace dch::cli

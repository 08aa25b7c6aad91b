// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "files/line_reader.hpp"
#include "frames/cell.hpp"
#include "lammps/dump_columns.hpp"

namespace dch::trajectory {

/// All of a LAMMPS dump's frame that stands above its atoms.
struct DumpHeader {
  std::int64_t step = 0;
  std::optional<double> time;
  std::int64_t atoms = 0;
  std::int64_t atoms_line = 0;  ///< number of the line that holds the number of atoms
  Cell cell;
  Box box;
  DumpColumns columns;
};

/// Reads the items of a frame up to and with the "ITEM: ATOMS" line.
///
/// TIMESTEP, NUMBER OF ATOMS and BOX BOUNDS must be there, UNITS and TIME may be (docs.lammps.org/dump.html).
class DumpHeaderReader {
 public:
  explicit DumpHeaderReader(LineReader& lines) : lines_(lines) {}

  /// Reads "ITEM: UNITS" if the file starts with it (LAMMPS writes it there and nowhere else), so that
  /// units() is known before the first frame. @throws FileError.
  void read_leading_units();

  /// False if the file ends before the frame begins.
  /// @throws FileError for anything else than the items named above.
  bool read(DumpHeader& header);

  /// What the last UNITS item said; empty if there was none yet.
  const std::string& units() const { return units_; }

 private:
  bool skip_blank_lines(std::string_view& line);
  void read_item(std::string_view item, DumpHeader& header);
  void mark_seen(bool& seen, std::string_view item) const;
  std::string_view value_line(const char* what);
  void read_box(std::string_view labels, DumpHeader& header);
  void read_columns(std::string_view names, DumpHeader& header);

  LineReader& lines_;
  std::string units_;
  struct Seen {
    bool units = false, time = false, step = false, atoms = false, box = false, columns = false;
  };
  Seen seen_;  ///< items of the present frame
};

}  // namespace dch::trajectory

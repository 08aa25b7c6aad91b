// SPDX-License-Identifier: MIT
#include "lammps/dump_header.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "lammps/dump_box.hpp"

namespace dch::trajectory {
namespace {

constexpr std::string_view kItem = "ITEM:";

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

void DumpHeaderReader::read_leading_units() {
  std::string_view line;
  if (!lines_.next(line)) return;
  std::string_view item = line;
  if (take_prefix(item, kItem) && trimmed(item) == "UNITS") {
    DumpHeader unused;
    read_item("UNITS", unused);
  } else {
    lines_.put_back();
  }
}

bool DumpHeaderReader::read(DumpHeader& header) {
  header = DumpHeader();
  std::string_view line;
  if (!skip_blank_lines(line)) {
    if (seen_.units) lines_.fail_here("the file ends behind 'ITEM: UNITS': it holds no frame");
    return false;
  }
  while (true) {
    if (!take_prefix(line, kItem)) lines_.fail_here("expected 'ITEM: ...', found " + in_quotes(line));
    read_item(trimmed(line), header);
    if (seen_.columns) {
      seen_ = Seen();
      return true;
    }
    if (!lines_.next(line))
      lines_.fail_here("the file ends in front of 'ITEM: ATOMS': the frame is not complete");
  }
}

bool DumpHeaderReader::skip_blank_lines(std::string_view& line) {
  do {
    if (!lines_.next(line)) return false;
  } while (is_blank(line));
  return true;
}

void DumpHeaderReader::mark_seen(bool& seen, std::string_view item) const {
  if (std::exchange(seen, true)) lines_.fail_here("a second " + in_quotes(item) + " in the same frame");
}

void DumpHeaderReader::read_item(std::string_view item, DumpHeader& header) {
  std::string_view rest = item;
  if (item == "TIMESTEP") {
    mark_seen(seen_.step, item);
    const std::string_view value = value_line("time step");
    if (!parse_number(value, header.step))
      lines_.fail_here("expected a time step (an integer), found " + in_quotes(value));
  } else if (item == "TIME") {
    mark_seen(seen_.time, item);
    const std::string_view value = value_line("time");
    double time = 0;
    if (!parse_number(value, time) || !std::isfinite(time))
      lines_.fail_here("expected a time (a number), found " + in_quotes(value));
    header.time = time;
  } else if (item == "UNITS") {
    mark_seen(seen_.units, item);
    units_ = std::string(value_line("unit style"));
  } else if (item == "NUMBER OF ATOMS") {
    mark_seen(seen_.atoms, item);
    const std::string_view value = value_line("number of atoms");
    header.atoms_line = lines_.number();
    if (!parse_number(value, header.atoms) || header.atoms < 0 ||
        header.atoms > std::numeric_limits<std::int32_t>::max()) {
      lines_.fail_here("expected a number of atoms from 0 to 2147483647, found " + in_quotes(value));
    }
  } else if (take_prefix(rest, "BOX BOUNDS")) {
    mark_seen(seen_.box, "BOX BOUNDS");
    read_box(rest, header);
  } else if (take_prefix(rest, "ATOMS")) {
    seen_.columns = true;
    read_columns(rest, header);
  } else {
    lines_.fail_here("unknown item " + in_quotes(item) +
                     "; known are UNITS, TIME, TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS, ATOMS");
  }
}

std::string_view DumpHeaderReader::value_line(const char* what) {
  std::string_view line;
  if (!lines_.next(line))
    lines_.fail_here(std::string("the file ends in front of the ") + what + ": it is truncated");
  return trimmed(line);
}

void DumpHeaderReader::read_box(std::string_view labels, DumpHeader& header) {
  // The labels lie in the reader's buffer, which reading on overwrites.
  header.cell = read_dump_cell(lines_, std::string(labels));
  try {
    header.box = header.cell.box();
  } catch (const InvalidBox& error) {
    lines_.fail_here(error.what());
  }
}

void DumpHeaderReader::read_columns(std::string_view names, DumpHeader& header) {
  if (!seen_.step) lines_.fail_here("no 'ITEM: TIMESTEP' above the atoms");
  if (!seen_.atoms) lines_.fail_here("no 'ITEM: NUMBER OF ATOMS' above the atoms");
  if (!seen_.box) lines_.fail_here("no 'ITEM: BOX BOUNDS' above the atoms");
  if (const std::string problem = parse_dump_columns(names, header.columns); !problem.empty()) {
    lines_.fail_here(problem);
  }
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "lammps/dump_box.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <initializer_list>
#include <string>
#include <vector>

#include "base/text.hpp"

namespace dch::trajectory {
namespace {

using Row = std::array<double, 4>;
using Rows = std::array<Row, 3>;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::string_view word; next_word(text, word);) words.push_back(word);
  return words;
}

enum class Layout { bounds, tilted_bounds, vectors };

struct Labels {
  Layout layout = Layout::bounds;
  Box::Periodic periodic{true, true, true};
};

bool starts_with(const std::vector<std::string_view>& words, std::initializer_list<std::string_view> start) {
  return words.size() >= start.size() && std::equal(start.begin(), start.end(), words.begin());
}

/// One pair of boundary letters: p periodic; f, s, m fixed, shrink-wrapped, shrink-wrapped with a minimum.
bool parse_boundary(std::string_view word, bool& periodic) {
  if (word.size() != 2 || word.find_first_not_of("pfsm") != std::string_view::npos) return false;
  periodic = word == "pp";
  return periodic || word.find('p') == std::string_view::npos;
}

Labels parse_labels(const LineReader& lines, std::string_view text) {
  std::vector<std::string_view> words = split(text);
  Labels labels;
  if (starts_with(words, {"xy", "xz", "yz"})) {
    labels.layout = Layout::tilted_bounds;
    words.erase(words.begin(), words.begin() + 3);
  } else if (starts_with(words, {"abc", "origin"})) {
    labels.layout = Layout::vectors;
    words.erase(words.begin(), words.begin() + 2);
  }
  if (words.empty()) return labels;
  bool good = words.size() == 3;
  for (std::size_t axis = 0; good && axis < 3; ++axis)
    good = parse_boundary(words[axis], labels.periodic[axis]);
  if (!good) {
    lines.fail_here("expected three pairs of the boundary letters p, f, s, m such as 'pp pp ff', found " +
                    in_quotes(text));
  }
  return labels;
}

Row read_row(LineReader& lines, std::size_t count) {
  std::string_view line;
  if (!lines.next(line)) lines.fail_here("the file ends inside the box: it is truncated");
  const std::vector<std::string_view> words = split(line);
  if (words.size() != count) {
    lines.fail_here(
        fmt::format("expected {} numbers in this line of the box, found {}", count, in_quotes(line)));
  }
  Row row{};
  for (std::size_t k = 0; k < count; ++k) {
    if (!parse_number(words[k], row[k]) || !is_valid_coordinate(row[k])) {
      lines.fail_here("expected a finite number in the box, found " + in_quotes(words[k]));
    }
  }
  return row;
}

/// Edges of the box whose bounding box is given (docs.lammps.org/Howto_triclinic.html).
Cell tilted_cell(const Rows& rows) {
  const double xy = rows[0][2], xz = rows[1][2], yz = rows[2][2];
  const double x_low = rows[0][0] - std::min({0.0, xy, xz, xy + xz});
  const double x_high = rows[0][1] - std::max({0.0, xy, xz, xy + xz});
  const double y_low = rows[1][0] - std::min(0.0, yz);
  const double y_high = rows[1][1] - std::max(0.0, yz);
  Cell cell;
  cell.origin = {x_low, y_low, rows[2][0]};
  cell.edges = {Vec3{x_high - x_low, 0, 0}, Vec3{xy, y_high - y_low, 0},
                Vec3{xz, yz, rows[2][1] - rows[2][0]}};
  return cell;
}

Cell vector_cell(const Rows& rows) {
  Cell cell;
  for (std::size_t k = 0; k < 3; ++k) {
    cell.edges[k] = {rows[k][0], rows[k][1], rows[k][2]};
    cell.origin[static_cast<int>(k)] = rows[k][3];
  }
  return cell;
}

/// @param first_line number of the line of the first axis
void check_extents(const LineReader& lines, const Cell& cell, std::int64_t first_line) {
  if (cell.is_zero()) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = cell.edges[static_cast<std::size_t>(axis)][axis];
    if (extent > 0) continue;
    lines.fail_in_line(first_line + axis,
                       fmt::format("the box has the extent {} along {}; it must be above 0 (or all "
                                   "numbers 0 for no box)",
                                   extent, "xyz"[axis]));
  }
}

}  // namespace

Cell read_dump_cell(LineReader& lines, std::string_view text) {
  const Labels labels = parse_labels(lines, text);
  const std::size_t count = labels.layout == Layout::bounds          ? 2
                            : labels.layout == Layout::tilted_bounds ? 3
                                                                     : 4;
  const std::int64_t first_line = lines.number() + 1;
  Rows rows{};
  for (Row& row : rows) row = read_row(lines, count);
  Cell cell = labels.layout == Layout::vectors ? vector_cell(rows) : tilted_cell(rows);
  cell.periodic = labels.periodic;
  if (labels.layout != Layout::vectors) check_extents(lines, cell, first_line);
  return cell;
}

}  // namespace dch::trajectory

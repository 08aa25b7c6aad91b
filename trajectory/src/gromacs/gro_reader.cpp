// SPDX-License-Identifier: MIT
#include "gromacs/gro_reader.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "base/text.hpp"
#include "frames/cell.hpp"

namespace dch::trajectory {
namespace {

constexpr std::size_t kCoordinatesBegin = 20;  ///< columns of residue number and name, atom name and number

std::string_view without_blanks(std::string_view field) {
  std::string_view word;
  return next_word(field, word) && is_blank(field) ? word : std::string_view();
}

/// The number behind a word of the title, such as "t=": all of it that can be one.
template <class T>
bool find_number(std::string_view title, std::string_view word, T& value) {
  const std::size_t at = title.find(word);
  if (at == std::string_view::npos) return false;
  title.remove_prefix(at + word.size());
  std::string_view number;
  if (!next_word(title, number)) return false;
  return std::from_chars(number.data(), number.data() + number.size(), value).ec == std::errc();
}

}  // namespace

bool GroReader::read(Frame& frame) {
  lines_.set_frame(frames_);
  std::string_view title;
  if (!find_title(title)) {
    if (frames_ == 0) lines_.fail_here("the file holds no frame");
    return false;
  }
  read_title(title, frame);
  const std::int64_t atoms = read_count();
  read_atoms(atoms, frame);
  frame.box = read_box();
  if (frames_ == 0) atoms_ = atoms;
  if (atoms != atoms_) {
    lines_.fail_in_line(title_line_,
                        fmt::format("the frame has {} atoms, the first frame {}", atoms, atoms_));
  }
  frame.ids.resize(frame.positions.size());
  std::iota(frame.ids.begin(), frame.ids.end(), std::int64_t{1});
  frame.types.clear();
  frame.molecules.clear();
  frame.images.clear();
  ++frames_;
  return true;
}

/// A title may be blank, but blank lines up to the end of the file are no frame.
bool GroReader::find_title(std::string_view& title) {
  while (lines_.next(title)) {
    title_line_ = lines_.number();
    if (!is_blank(title)) return true;
  }
  return false;
}

void GroReader::read_title(std::string_view title, Frame& frame) const {
  frame.step = frames_;
  find_number(title, "step=", frame.step);
  frame.time.reset();
  double time = 0;
  if (find_number(title, "t=", time) && std::isfinite(time)) frame.time = time;
}

std::string_view GroReader::line_of(const char* what) {
  std::string_view line;
  if (!lines_.next(line)) {
    lines_.fail_here(fmt::format("the file ends in front of {}: it is truncated", what));
  }
  return line;
}

std::int64_t GroReader::read_count() {
  const std::string_view line = line_of("the number of atoms");
  std::int32_t count = 0;
  if (!parse_number(without_blanks(line), count) || count <= 0) {
    lines_.fail_here("expected a number of atoms above 0, found " + in_quotes(line));
  }
  return count;
}

void GroReader::read_atoms(std::int64_t atoms, Frame& frame) {
  frame.positions.clear();
  for (std::int64_t k = 0; k < atoms; ++k) {
    std::string_view line;
    if (!lines_.next(line)) {
      lines_.fail_here(
          fmt::format("the file ends after {} of the frame's {} atoms: it is truncated", k, atoms));
    }
    if (k == 0) width_ = find_width(line);
    frame.positions.push_back(read_atom(line));
  }
}

Vec3 GroReader::read_atom(std::string_view line) const {
  Vec3 position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t begin = kCoordinatesBegin + axis * width_;
    const std::string_view field = begin < line.size() ? line.substr(begin, width_) : std::string_view();
    double& value = position[static_cast<int>(axis)];
    if (!parse_number(without_blanks(field), value) || !is_valid_coordinate(value)) {
      lines_.fail_here(fmt::format("expected the coordinate {} in the columns {} to {}, found {}",
                                   "xyz"[axis], begin + 1, begin + width_, in_quotes(line)));
    }
  }
  return position;
}

/// The distance of the decimal points is the width of a field.
std::size_t GroReader::find_width(std::string_view line) const {
  const std::size_t first = line.find('.', kCoordinatesBegin);
  const std::size_t second = first == std::string_view::npos ? first : line.find('.', first + 1);
  if (second == std::string_view::npos) {
    lines_.fail_here("expected an atom with three coordinates from column 21 on, found " + in_quotes(line));
  }
  return second - first;
}

/// Three lengths, or the diagonal and then the six other components: v1(y) v1(z) v2(x) v2(z) v3(x) v3(y).
Box GroReader::read_box() {
  const std::string_view line = line_of("the box");
  std::array<double, 9> numbers{};
  std::size_t count = 0;
  std::string_view rest = line;
  for (std::string_view word; next_word(rest, word); ++count) {
    double value = 0;
    if (!parse_number(word, value) || !is_valid_coordinate(value)) {
      lines_.fail_here("expected a number in the box, found " + in_quotes(word));
    }
    if (count < numbers.size()) numbers[count] = value;
  }
  if (count != 3 && count != 9) {
    lines_.fail_here(
        fmt::format("expected 3 or 9 numbers for the box, found {}: {}", count, in_quotes(line)));
  }
  Cell cell;
  cell.edges = {Vec3{numbers[0], numbers[3], numbers[4]}, Vec3{numbers[5], numbers[1], numbers[6]},
                Vec3{numbers[7], numbers[8], numbers[2]}};
  try {
    return cell.box();
  } catch (const InvalidBox& error) {
    lines_.fail_here(error.what());
  }
}

}  // namespace dch::trajectory

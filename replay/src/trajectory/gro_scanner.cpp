// SPDX-License-Identifier: MIT
#include <array>
#include <fmt/format.h>

#include "cell.hpp"
#include "frame_scanner.hpp"
#include "line_reader.hpp"
#include "text.hpp"

namespace dch::trajectory {
namespace {

constexpr std::size_t kCoordinatesBegin = 20;  ///< columns of residue number and name, atom name and number

std::string_view without_blanks(std::string_view field) {
  std::string_view word;
  return next_word(field, word) && is_blank(field) ? word : std::string_view();
}

/// GROMACS GRO: a title, the number of atoms, one line of fixed columns an atom, the box (GROMACS reference
/// manual, "gro format"). libgromacs reads what it can of a broken number, so all of them are checked here.
class GroScanner final : public FrameScanner {
 public:
  explicit GroScanner(const std::string& path) : lines_(path, FinalNewline::required) {}

  bool next(FrameSummary& summary) override {
    lines_.set_frame(frames_);
    if (!find_title()) return false;
    summary = FrameSummary();
    summary.place = fmt::format("line {}", lines_.number());
    summary.atoms = scan_count();
    width_ = 0;
    for (std::int64_t k = 0; k < summary.atoms; ++k) scan_atom(k, summary.atoms);
    scan_box();
    ++frames_;
    return true;
  }

 private:
  /// A title may be blank, but blank lines up to the end of the file are no frame.
  bool find_title() {
    std::string_view line;
    while (lines_.next(line)) {
      if (!is_blank(line)) return true;
    }
    return false;
  }

  std::string_view line_of(const char* what) {
    std::string_view line;
    if (!lines_.next(line))
      lines_.fail_here(fmt::format("the file ends in front of {}: it is truncated", what));
    return line;
  }

  std::int64_t scan_count() {
    const std::string_view line = line_of("the number of atoms");
    std::int32_t count = 0;
    if (!parse_number(without_blanks(line), count) || count <= 0) {
      lines_.fail_here("expected a number of atoms above 0, found " + in_quotes(line));
    }
    return count;
  }

  void scan_atom(std::int64_t k, std::int64_t atoms) {
    std::string_view line;
    if (!lines_.next(line)) {
      lines_.fail_here(
          fmt::format("the file ends after {} of the frame's {} atoms: it is truncated", k, atoms));
    }
    if (width_ == 0) width_ = find_width(line);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t begin = kCoordinatesBegin + axis * width_;
      const std::string_view field = begin < line.size() ? line.substr(begin, width_) : std::string_view();
      double value = 0;
      if (!parse_number(without_blanks(field), value) || !is_valid_coordinate(value)) {
        lines_.fail_here(fmt::format("expected the coordinate {} in the columns {} to {}, found {}",
                                     "xyz"[axis], begin + 1, begin + width_, in_quotes(line)));
      }
    }
  }

  /// The distance of the decimal points is the width of a field.
  std::size_t find_width(std::string_view line) const {
    const std::size_t first = line.find('.', kCoordinatesBegin);
    const std::size_t second = first == std::string_view::npos ? first : line.find('.', first + 1);
    if (second == std::string_view::npos) {
      lines_.fail_here("expected an atom with three coordinates from column 21 on, found " + in_quotes(line));
    }
    return second - first;
  }

  void scan_box() {
    const std::string_view line = line_of("the box");
    std::size_t count = 0;
    std::string_view rest = line;
    for (std::string_view word; next_word(rest, word); ++count) {
      double value = 0;
      if (!parse_number(word, value) || !is_valid_coordinate(value)) {
        lines_.fail_here("expected a number in the box, found " + in_quotes(word));
      }
    }
    if (count != 3 && count != 9) {
      lines_.fail_here(
          fmt::format("expected 3 or 9 numbers for the box, found {}: {}", count, in_quotes(line)));
    }
  }

  LineReader lines_;
  std::int64_t frames_ = 0;
  std::size_t width_ = 0;
};

}  // namespace

std::unique_ptr<FrameScanner> make_gro_scanner(const std::string& path) {
  return std::make_unique<GroScanner>(path);
}

}  // namespace dch::trajectory

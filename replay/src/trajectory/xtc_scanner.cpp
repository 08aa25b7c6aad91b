// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "frame_scanner.hpp"
#include "xdr_cursor.hpp"

namespace dch::trajectory {
namespace {

constexpr std::int32_t kMagic = 1995;
constexpr std::int32_t kMagicOfLargeSystems = 2023;  ///< written by GROMACS from 2023 on for over 3e8 atoms
constexpr std::int64_t kMostUncompressedAtoms = 9;

/// GROMACS XTC: a header, the box, and the coordinates as integers in a bit stream, whose length is stored.
/// Layout: GROMACS reference manual, "xtc format"; limits of the bit stream from its decoder.
class XtcScanner final : public FrameScanner {
 public:
  explicit XtcScanner(const std::string& path) : cursor_(path) {}

  bool next(FrameSummary& summary) override {
    if (cursor_.at_end()) return false;
    cursor_.set_frame(frames_);
    summary = FrameSummary();
    summary.place = fmt::format("byte {}", cursor_.offset());
    summary.atoms = scan_header();
    scan_coordinates(summary.atoms);
    ++frames_;
    return true;
  }

 private:
  std::int64_t scan_header() {
    const std::int32_t magic = cursor_.read_int("the XTC magic number");
    if (magic == kMagicOfLargeSystems)
      cursor_.fail_here("XTC files with 64-bit sizes (magic 2023) are not supported");
    if (magic != kMagic)
      cursor_.fail_here(fmt::format("expected the XTC magic number {}, found {}", kMagic, magic));
    const std::int32_t atoms = cursor_.read_int("the number of atoms");
    if (atoms <= 0) cursor_.fail_here(fmt::format("expected a number of atoms above 0, found {}", atoms));
    cursor_.read_int("the step");
    cursor_.read_finite_reals("the time", 1);
    cursor_.read_finite_reals("the box", 9);
    return atoms;
  }

  void scan_coordinates(std::int64_t atoms) {
    const std::int32_t again = cursor_.read_int("the number of coordinates");
    if (again != atoms)
      cursor_.fail_here(fmt::format("expected {} coordinates as in the header, found {}", atoms, again));
    if (atoms <= kMostUncompressedAtoms) {
      cursor_.read_finite_reals("the coordinates", 3 * atoms);
      return;
    }
    const double precision = cursor_.read_real("the precision");
    if (!(precision > 0) || !std::isfinite(precision)) {
      cursor_.fail_here(fmt::format("expected a precision above 0, found {}", precision));
    }
    scan_range();
    scan_bit_stream(atoms);
  }

  void scan_range() {
    std::array<std::int32_t, 3> low{};
    for (std::int32_t& value : low) value = cursor_.read_int("the smallest coordinates");
    for (const std::int32_t value : low) {
      const std::int32_t high = cursor_.read_int("the largest coordinates");
      if (high < value)
        cursor_.fail_here(fmt::format("the largest coordinate {} lies below the smallest {}", high, value));
    }
  }

  void scan_bit_stream(std::int64_t atoms) {
    constexpr std::int32_t kFirst = 9,
                           kLast = 72;  // entries of the decoder's table of step sizes that may start it
    const std::int32_t small = cursor_.read_int("the index of the step size");
    if (small < kFirst || small > kLast) {
      cursor_.fail_here(
          fmt::format("expected an index of the step size from {} to {}, found {}", kFirst, kLast, small));
    }
    const std::int32_t bytes = cursor_.read_int("the size of the compressed coordinates");
    constexpr std::int64_t kMostAtomsPerByte = 8;  // every atom takes a bit at least
    if (bytes <= 0 || atoms > kMostAtomsPerByte * bytes) {
      cursor_.fail_here(
          fmt::format("{} bytes cannot hold the compressed coordinates of {} atoms", bytes, atoms));
    }
    cursor_.skip("the compressed coordinates", bytes);
  }

  XdrCursor cursor_;
  std::int64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<FrameScanner> make_xtc_scanner(const std::string& path) {
  return std::make_unique<XtcScanner>(path);
}

}  // namespace dch::trajectory

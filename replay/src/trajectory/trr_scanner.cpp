// SPDX-License-Identifier: MIT
#include <array>
#include <fmt/format.h>

#include "frame_scanner.hpp"
#include "text.hpp"
#include "xdr_cursor.hpp"

namespace dch::trajectory {
namespace {

constexpr std::int32_t kMagic = 1993;
constexpr std::string_view kVersion = "GMX_trn_file";

/// Sizes in bytes of the blocks of a TRR frame, in the file's order, and the numbers behind them.
struct Header {
  enum Block {
    input_record,
    energies,
    box,
    virial,
    pressure,
    topology,
    symbols,
    positions,
    velocities,
    forces,
    blocks
  };
  std::array<std::int64_t, blocks> size{};
  std::int64_t atoms = 0;
};

/// GROMACS TRR: a header with the sizes of the blocks that follow (GROMACS reference manual, "trr format").
class TrrScanner final : public FrameScanner {
 public:
  explicit TrrScanner(const std::string& path) : cursor_(path) {}

  bool next(FrameSummary& summary) override {
    if (cursor_.at_end()) return false;
    cursor_.set_frame(frames_);
    summary = FrameSummary();
    summary.place = fmt::format("byte {}", cursor_.offset());
    const Header header = scan_header();
    for (const std::int64_t size : header.size) cursor_.skip("a block of the frame", size);
    summary.atoms = header.atoms;
    summary.has_positions = header.size[Header::positions] != 0;
    ++frames_;
    return true;
  }

 private:
  Header scan_header() {
    scan_magic();
    Header header;
    for (std::int64_t& size : header.size) size = cursor_.read_int("the sizes of the blocks");
    header.atoms = cursor_.read_int("the number of atoms");
    if (header.atoms <= 0)
      cursor_.fail_here(fmt::format("expected a number of atoms above 0, found {}", header.atoms));
    const std::int64_t real = real_size(header);
    check_sizes(header, real);
    cursor_.read_int("the step");
    cursor_.read_int("the number of energies");
    cursor_.read_finite_reals("the time", 1, real);
    cursor_.read_finite_reals("lambda", 1, real);
    return header;
  }

  void scan_magic() {
    const std::int32_t magic = cursor_.read_int("the TRR magic number");
    if (magic != kMagic)
      cursor_.fail_here(fmt::format("expected the TRR magic number {}, found {}", kMagic, magic));
    const auto length = static_cast<std::int32_t>(kVersion.size());
    const std::int32_t with_end = cursor_.read_int("the length of the version");
    if (with_end != length + 1) cursor_.fail_here(fmt::format("expected {}, found {}", length + 1, with_end));
    const std::int32_t without_end = cursor_.read_int("the length of the version");
    if (without_end != length) cursor_.fail_here(fmt::format("expected {}, found {}", length, without_end));
    const std::string version = cursor_.read_bytes("the version", length);
    if (version != kVersion) cursor_.fail_here("expected 'GMX_trn_file', found " + in_quotes(version));
  }

  /// Bytes a number: the first block that is there tells.
  std::int64_t real_size(const Header& header) const {
    const std::int64_t vectors = 3 * header.atoms;
    if (header.size[Header::box] != 0) return header.size[Header::box] / 9;
    for (const auto block : {Header::positions, Header::velocities, Header::forces}) {
      if (header.size[block] != 0) return header.size[block] / vectors;
    }
    cursor_.fail_here("the frame has neither box nor positions, velocities or forces");
  }

  void check_sizes(const Header& header, std::int64_t real) const {
    if (real != 4 && real != 8)
      cursor_.fail_here(fmt::format("expected numbers of 4 or 8 bytes, found {}", real));
    const std::int64_t matrix = 9 * real, vectors = 3 * header.atoms * real;
    const std::array<std::int64_t, Header::blocks> expected{0, 0, matrix,  matrix,  matrix,
                                                            0, 0, vectors, vectors, vectors};
    for (std::size_t block = 0; block < expected.size(); ++block) {
      if (header.size[block] == 0 || header.size[block] == expected[block]) continue;
      cursor_.fail_here(fmt::format("block {} of the frame has {} bytes, expected 0 or {} for {} atoms",
                                    block, header.size[block], expected[block], header.atoms));
    }
  }

  XdrCursor cursor_;
  std::int64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<FrameScanner> make_trr_scanner(const std::string& path) {
  return std::make_unique<TrrScanner>(path);
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "gromacs_oracle.hpp"

#include <algorithm>
#include <gromacs/fileio/oenv.h>
#include <gromacs/fileio/trxio.h>
#include <gromacs/trajectory/trajectoryframe.h>
#include <stdexcept>

namespace dch::trajectory::test {
namespace {

class GromacsFile {
 public:
  explicit GromacsFile(std::string path) : path_(std::move(path)) { output_env_init_default(&environment_); }
  ~GromacsFile() {
    if (status_ != nullptr) close_trx(status_);
    output_env_done(environment_);
    done_frame(&frame_);
  }
  GromacsFile(const GromacsFile&) = delete;
  GromacsFile& operator=(const GromacsFile&) = delete;

  const t_trxframe* next() {
    const bool good = status_ == nullptr
                          ? read_first_frame(environment_, &status_, path_.c_str(), &frame_, TRX_NEED_X)
                          : read_next_frame(environment_, status_, &frame_);
    return good && frame_.bX ? &frame_ : nullptr;
  }

 private:
  std::string path_;
  gmx_output_env_t* environment_ = nullptr;
  t_trxstatus* status_ = nullptr;
  t_trxframe frame_{};
};

void copy(const real* from, std::array<float, 3>& to) { std::copy(from, from + 3, to.begin()); }

}  // namespace

void write_by_gromacs(const std::string& path, const std::vector<GromacsFrame>& frames) {
  t_trxstatus* file = open_trx(path.c_str(), "w");
  for (const GromacsFrame& frame : frames) {
    std::vector<std::array<float, 3>> positions = frame.positions;
    t_trxframe out{};
    clear_trxframe(&out, true);
    out.natoms = static_cast<int>(positions.size());
    out.bStep = out.bTime = out.bX = out.bPrec = true;
    out.step = frame.step;
    out.time = frame.time;
    out.prec = frame.precision;
    out.x = reinterpret_cast<rvec*>(positions.data());
    out.bV = frame.has_velocities;
    out.v = out.x;
    out.bBox = frame.has_box;
    for (std::size_t k = 0; k < 3; ++k) std::copy(frame.box[k].begin(), frame.box[k].end(), out.box[k]);
    write_trxframe(file, &out, nullptr);
  }
  close_trx(file);
}

std::vector<GromacsFrame> read_by_gromacs(const std::string& path) {
  GromacsFile file(path);
  std::vector<GromacsFrame> frames;
  while (const t_trxframe* from = file.next()) {
    GromacsFrame frame;
    frame.step = from->step;
    frame.time = from->time;
    frame.has_box = from->bBox;
    for (std::size_t k = 0; k < 3; ++k) copy(from->box[k], frame.box[k]);
    frame.positions.resize(static_cast<std::size_t>(from->natoms));
    for (std::size_t k = 0; k < frame.positions.size(); ++k) copy(from->x[k], frame.positions[k]);
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::size_t skim_by_gromacs(const std::string& path) {
  GromacsFile file(path);
  std::size_t frames = 0;
  while (file.next() != nullptr) ++frames;
  return frames;
}

}  // namespace dch::trajectory::test

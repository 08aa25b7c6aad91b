// SPDX-License-Identifier: MIT
#include "gromacs_file.hpp"

#include <gromacs/fileio/oenv.h>
#include <gromacs/fileio/trxio.h>
#include <gromacs/trajectory/trajectoryframe.h>
#include <utility>

#include "cell.hpp"

namespace dch::trajectory {
namespace {

Vec3 vec3_of(const real* p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

Box box_of(const t_trxframe& from) {
  if (!from.bBox) return Box::none();
  Cell cell;
  for (int k = 0; k < 3; ++k) cell.edges[static_cast<std::size_t>(k)] = vec3_of(from.box[k]);
  return cell.box();
}

}  // namespace

struct GromacsFile::Impl {
  gmx_output_env_t* environment = nullptr;
  t_trxstatus* status = nullptr;
  t_trxframe frame{};

  ~Impl() {
    if (status != nullptr) close_trx(status);
    output_env_done(environment);
    done_frame(&frame);
  }
};

GromacsFile::GromacsFile(std::string path) : path_(std::move(path)), impl_(std::make_unique<Impl>()) {
  output_env_init_default(&impl_->environment);
}

GromacsFile::~GromacsFile() = default;

bool GromacsFile::read(Frame& frame) {
  t_trxframe& from = impl_->frame;
  const bool good = impl_->status == nullptr ? read_first_frame(impl_->environment, &impl_->status,
                                                                path_.c_str(), &from, TRX_NEED_X)
                                             : read_next_frame(impl_->environment, impl_->status, &from);
  if (!good || !from.bX) return false;
  frame.step = from.bStep ? from.step : frame.step;
  frame.time.reset();
  if (from.bTime) frame.time = static_cast<double>(from.time);
  frame.box = box_of(from);
  frame.positions.resize(static_cast<std::size_t>(from.natoms));
  for (std::size_t k = 0; k < frame.positions.size(); ++k) frame.positions[k] = vec3_of(from.x[k]);
  return true;
}

}  // namespace dch::trajectory

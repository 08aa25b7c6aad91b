// SPDX-License-Identifier: MIT
//
// A reader of trajectories (DCH_FUZZ_ENDING says of which files): any bytes give frames within their limits
// or a FileError.
#include <cmath>

#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/reader.hpp>

#include "input_on_disk.hpp"

namespace dch::fuzz {
namespace {

void check(const trajectory::Frame& frame) {
  const std::size_t atoms = frame.positions.size();
  if (frame.ids.size() != atoms) fail("not one id for each atom");
  for (const std::size_t size : {frame.types.size(), frame.molecules.size(), frame.images.size()})
    if (size != 0 && size != atoms) fail("a column that is not of one entry for each atom");
  for (const Vec3 p : frame.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) <= kMaxCoordinate)) fail("a coordinate that is not finite, or too large");
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static dch::fuzz::InputOnDisk file("input" DCH_FUZZ_ENDING);
  try {
    const auto reader =
        dch::trajectory::open_trajectory(file.write({reinterpret_cast<const char*>(data), size}));
    for (dch::trajectory::Frame frame; reader->read(frame);) dch::fuzz::check(frame);
  } catch (const dch::trajectory::FileError&) {
    return 0;  // an answer to any broken file
  }
  return 0;
}

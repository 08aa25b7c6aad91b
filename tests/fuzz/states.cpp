// SPDX-License-Identifier: MIT
//
// Restart files of hard spheres: any bytes give spheres that the library takes or refuses, or a FileError;
// what is taken does not overlap, and is the same when written and read again.
#include <dch/kinetic/hard_spheres.hpp>
#include <dch/trajectory/file_error.hpp>

#include "input/sphere_state.hpp"
#include "input_on_disk.hpp"

namespace dch::fuzz {
namespace {

void check(InputOnDisk& file, const cli::SphereState& state) {
  const std::string text = cli::render_state(state);
  if (cli::render_state(cli::read_state(file.write(text))) != text) fail("another state when read again");
  const kinetic::HardSpheres spheres({state.box(), state.radii, state.masses, 1}, state.positions,
                                     state.velocities, state.time);
  if (!(spheres.least_gap() >= -kinetic::kTouching)) fail("spheres that overlap");
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static dch::fuzz::InputOnDisk file("state.json");
  try {
    dch::fuzz::check(file, dch::cli::read_state(file.write(dch::fuzz::FuzzInput(data, size).rest())));
  } catch (const dch::Error&) {
    return 0;  // FileError is one too
  }
  return 0;
}

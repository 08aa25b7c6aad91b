// SPDX-License-Identifier: MIT
//
// Files of bonds and chains: any bytes give bonds between atoms that there are, or a FileError.
#include <dch/trajectory/file_error.hpp>
#include <dch/trajectory/topology.hpp>

#include "input_on_disk.hpp"

namespace dch::fuzz {
namespace {

const std::vector<std::int64_t> kIds{1, 2, 3, 5, 8, 10, 11, 12, 4000000000};

void check(const trajectory::Topology& topology) {
  const auto atoms = static_cast<std::int32_t>(kIds.size());
  for (const auto& [a, b] : topology.bonds)
    if (a == b || a < 0 || b < 0 || a >= atoms || b >= atoms) fail("a bond of atoms that there are not");
  for (const trajectory::AtomChain& chain : topology.chains)
    for (const std::int32_t atom : chain.atoms)
      if (atom < 0 || atom >= atoms) fail("a chain of atoms that there are not");
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using dch::fuzz::InputOnDisk;
  static InputOnDisk files[] = {InputOnDisk("input.bonds"), InputOnDisk("input.chains"),
                                InputOnDisk("input.data")};
  dch::fuzz::FuzzInput input(data, size);
  InputOnDisk& file = files[input.below(3)];
  try {
    dch::fuzz::check(dch::trajectory::read_topology(file.write(input.rest()), dch::fuzz::kIds));
  } catch (const dch::trajectory::FileError&) {
    return 0;  // an answer to any broken file
  }
  return 0;
}

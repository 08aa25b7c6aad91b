// SPDX-License-Identifier: MIT
#include <cstdio>

#include <dch/zonotope/zonotope.hpp>

int main() {
  const dch::zonotope::Zonotope cube{{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::printf("volume %g\n", dch::zonotope::volume(cube));
  return dch::zonotope::volume(cube) == 8 ? 0 : 1;
}

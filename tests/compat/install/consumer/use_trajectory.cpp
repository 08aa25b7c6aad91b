// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string>
#include <vector>

#include <dch/trajectory/reader.hpp>
#include <dch/trajectory/writer.hpp>

int main() {
  const std::string path = "two_atoms.lammpstrj";
  dch::trajectory::Frame frame;
  frame.box = dch::Box::orthorhombic({4, 5, 6});
  frame.positions = {{1, 2, 3}, {0.5, 0.25, 0.125}};
  frame.ids = {1, 2};
  auto writer = dch::trajectory::create_trajectory(path, "Angstrom");
  writer->write(frame);
  writer->close();

  dch::trajectory::Frame again;
  const bool read = dch::trajectory::open_trajectory(path)->read(again);
  std::remove(path.c_str());
  return read && again.positions == frame.positions ? 0 : 1;
}

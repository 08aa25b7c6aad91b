// SPDX-License-Identifier: MIT
#include "small_files.hpp"

#include <zlib.h>

#include <dch/trajectory/writer.hpp>

#include "dcd_file.hpp"
#include "sample_frames.hpp"
#include "trr_file.hpp"

namespace dch::trajectory::test {
namespace {

constexpr const char* kDumpFrame =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS xy xz yz pp pp ff\n-1.5 20 0.5\n0 30 0\n0 "
    "40 1\n"
    "ITEM: ATOMS id type x y z ix iy iz\n1 1 5.25 5.5 5 0 0 1\n3 5 6.5 6.5 6.5 -1 0 0\n2 1 1e1 2 3 0 0 0\n";

constexpr const char* kGroFrame =
    "Water, t= 1.5 step= 3\n    3\n"
    "    1WATER  OW1    1   0.126   1.624   1.679  0.1227 -0.0580  0.0434\n"
    "    1WATER  HW2    2   0.190   1.661   1.747  0.8085  0.3191 -0.7791\n"
    "    1WATER  HW3    3   0.177   1.568   1.613 -0.9045 -2.6469  1.3180\n"
    "   1.82060   2.82060   3.82060   0.00000   0.00000   0.10000   0.00000   0.20000   0.30000\n";

SmallFile repeated(const std::string& name, const std::string& frame) {
  return {name, frame + frame, {frame.size(), 2 * frame.size()}};
}

SmallFile dcd_file() {
  DcdFile file;
  file.atoms = 4;
  file.has_cell = true;
  file.append_header();
  SmallFile small{"test.dcd", "", {}};
  for (int k = 0; k < 2; ++k) {
    file.append_cell({10, 80, 20, 90, 100, 30});
    for (int axis = 0; axis < 3; ++axis) file.append_coordinates({1, 2, 3, 4});
    small.frame_ends.push_back(file.bytes().size());
  }
  small.bytes = file.bytes();
  return small;
}

SmallFile trr_file() {
  TrrFile<float> file;
  SmallFile small{"test.trr", "", {}};
  for (int k = 0; k < 2; ++k) {
    file.append_frame(4, k, {.box = true, .positions = true, .velocities = true});
    small.frame_ends.push_back(file.bytes().size());
  }
  small.bytes = file.bytes();
  return small;
}

SmallFile gzip_file(const ScratchFolder& folder) {
  const std::string text = repeated("", kDumpFrame).bytes;
  const gzFile file = gzopen(folder.path("small.gz").c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  const std::string bytes = read_file(folder.path("small.gz"));
  return {
      "test.dump.gz", bytes, {0, bytes.size()}, false};  // no cut leaves one frame; a checksum ends the file
}

SmallFile h5md_file(const ScratchFolder& folder) {
  const auto writer = create_trajectory(folder.path("small.h5"), "nm");
  for (int k = 0; k < 2; ++k) writer->write(sample_frame(k, Box::triclinic({9, 0, 0}, {1, 9, 0}, {2, 3, 9})));
  writer->close();
  const std::string bytes = read_file(folder.path("small.h5"));
  return {"test.h5", bytes, {0, bytes.size()}};
}

}  // namespace

std::vector<SmallFile> small_files(const ScratchFolder& folder) {
  const std::string xtc = read_file(data_path("cell_shapes.xtc"));
  return {repeated("test.dump", kDumpFrame),
          repeated("test.gro", kGroFrame),
          SmallFile{"test.xtc", xtc, {xtc.size() / 3, 2 * xtc.size() / 3, xtc.size()}},
          trr_file(),
          dcd_file(),
          gzip_file(folder),
          h5md_file(folder)};
}

}  // namespace dch::trajectory::test

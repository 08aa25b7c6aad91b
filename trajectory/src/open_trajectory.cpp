// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>

#include <dch/trajectory/reader.hpp>

#include "base/place.hpp"
#include "dcd/dcd_reader.hpp"
#include "files/file_name.hpp"
#include "gromacs/gro_reader.hpp"
#include "gromacs/gromacs_reader.hpp"
#include "h5md/h5md_reader.hpp"
#include "lammps/lammps_dump_reader.hpp"

namespace dch::trajectory {
namespace {

using MakeReader = std::unique_ptr<TrajectoryReader> (*)(const std::string& path, const ReadLimits& limits);

template <class Reader>
std::unique_ptr<TrajectoryReader> make(const std::string& path, const ReadLimits& limits) {
  return std::make_unique<Reader>(path, limits);
}

/// Of formats whose frames take a fixed multiple of their bytes in the file.
template <std::unique_ptr<TrajectoryReader> make_reader(const std::string&)>
std::unique_ptr<TrajectoryReader> without_limits(const std::string& path, const ReadLimits&) {
  return make_reader(path);
}

std::unique_ptr<TrajectoryReader> make_dcd_reader(const std::string& path) {
  return std::make_unique<DcdReader>(path);
}

struct Format {
  std::string_view ending;
  MakeReader make_reader;
};

constexpr Format kFormats[] = {
    {".lammpstrj", make<LammpsDumpReader>},
    {".dump", make<LammpsDumpReader>},
    {".lammpstrj.gz", make<LammpsDumpReader>},
    {".dump.gz", make<LammpsDumpReader>},
    {".dcd", without_limits<make_dcd_reader>},
    {".xtc", without_limits<make_xtc_reader>},
    {".trr", without_limits<make_trr_reader>},
    {".gro", make<GroReader>},
    {".h5", make_h5md_reader},
    {".h5md", make_h5md_reader},
};

std::string known_endings() {
  std::string list;
  for (const Format& format : kFormats) list += (list.empty() ? "" : " ") + std::string(format.ending);
  return list;
}

}  // namespace

std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, const ReadLimits& limits) {
  return open_trajectory(path, "", limits);
}

std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, const std::string& format,
                                                  const ReadLimits& limits) {
  const std::string name = format.empty() ? lower_case_name(path) : "x." + format;
  for (const Format& known : kFormats) {
    if (has_ending(name, known.ending)) return known.make_reader(path, limits);
  }
  fail(path, "unknown kind of trajectory; the endings known are " + known_endings());
}

std::vector<std::string> trajectory_formats() {
  std::vector<std::string> formats;
  for (const Format& format : kFormats) formats.emplace_back(format.ending.substr(1));
  return formats;
}

}  // namespace dch::trajectory

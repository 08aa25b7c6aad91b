// SPDX-License-Identifier: MIT
#include "report/crossing_file.hpp"

#include <fmt/format.h>
#include <limits>

#include "base/version.hpp"

namespace dch::cli {
namespace {

constexpr std::int64_t kCrossingChunk = 1024;

}  // namespace

CrossingFile::CrossingFile(const std::string& path, const CrossingReport& report) : file_(path) {
  file_.write_attribute("format", std::string("dch crossings 1"));
  file_.write_attribute("creator", fmt::format("dchmd {}", kVersion));
  file_.write_attribute("source", report.file);
  file_.write_attribute("topology", report.topology);
  file_.write_attribute("unit", report.unit);
  file_.write_attribute("thickness", report.thickness);
  file_.create_group("frames");
  for (const char* name : {"frame", "step", "crossings", "contacts", "undetermined"})
    file_.create_dataset(fmt::format("frames/{}", name), Hdf5Type::int64, 0, kCrossingChunk);
  file_.create_dataset("frames/time", Hdf5Type::float64, 0, kCrossingChunk);
  file_.create_group("crossings");
  for (const char* name : {"frame", "sign"})
    file_.create_dataset(fmt::format("crossings/{}", name), Hdf5Type::int64, 0, kChunkEntries);
  for (const char* name : {"bond_p", "bond_q"})
    file_.create_dataset(fmt::format("crossings/{}", name), Hdf5Type::int64, 2, kChunkEntries / 2);
  for (const char* name : {"time", "on_p", "on_q"})
    file_.create_dataset(fmt::format("crossings/{}", name), Hdf5Type::float64, 0, kChunkEntries);
  file_.create_dataset("crossings/place", Hdf5Type::float64, 3, kChunkEntries / 3);
}

void CrossingFile::append(const CrossingFrame& frame, const std::vector<CrossingEvent>& events) {
  const auto write = [&](const char* name, std::int64_t value) {
    file_.append(fmt::format("frames/{}", name), 0, std::vector<std::int64_t>{value});
  };
  write("frame", frame.frame);
  write("step", frame.step);
  write("crossings", frame.crossings);
  write("contacts", frame.contacts);
  write("undetermined", frame.undetermined);
  file_.append("frames/time", 0,
               std::vector<double>{frame.time.value_or(std::numeric_limits<double>::quiet_NaN())});
  if (events.empty()) return;
  std::vector<std::int64_t> frames, signs, p, q;
  std::vector<double> times, on_p, on_q, places;
  for (const CrossingEvent& event : events) {
    const necklace::Crossing& c = event.crossing;
    frames.push_back(event.frame);
    signs.push_back(c.sign);
    p.insert(p.end(), event.p.begin(), event.p.end());
    q.insert(q.end(), event.q.begin(), event.q.end());
    times.push_back(c.time);
    on_p.push_back(c.on_p);
    on_q.push_back(c.on_q);
    places.insert(places.end(), {c.place.x, c.place.y, c.place.z});
  }
  file_.append("crossings/frame", 0, frames);
  file_.append("crossings/sign", 0, signs);
  file_.append("crossings/bond_p", 2, p);
  file_.append("crossings/bond_q", 2, q);
  file_.append("crossings/time", 0, times);
  file_.append("crossings/on_p", 0, on_p);
  file_.append("crossings/on_q", 0, on_q);
  file_.append("crossings/place", 3, places);
}

}  // namespace dch::cli

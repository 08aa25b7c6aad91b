// SPDX-License-Identifier: MIT
#include "report/contact_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "base/version.hpp"

namespace dch::cli {
namespace {

constexpr std::int64_t kChunkRows = 1 << 13;

void create_column(Hdf5File& file, const std::string& name, Hdf5Type type) {
  file.create_dataset(name, type, 0, kChunkRows);
}

template <class Values>
void write_column(Hdf5File& file, const std::string& name, Hdf5Type type, const Values& values) {
  create_column(file, name, type);
  file.append(name, 0, values);
}

void write_chains(Hdf5File& file, const necklace::Necklace& necklace, const std::vector<std::int64_t>& ids) {
  std::vector<std::int64_t> order, first, ring;
  std::vector<double> radius;
  for (const std::int32_t particle : necklace.particle()) {
    order.push_back(ids[static_cast<std::size_t>(particle)]);
    radius.push_back(necklace.radius(particle));
  }
  for (std::size_t chain = 0; chain < necklace.chains().size(); ++chain) {
    ring.push_back(necklace.chains().closed(chain) ? 1 : 0);
  }
  for (std::size_t chain = 0; chain <= ring.size(); ++chain) first.push_back(necklace.first_place(chain));
  file.create_group("chains");
  write_column(file, "chains/ids", Hdf5Type::int64, order);
  write_column(file, "chains/radius", Hdf5Type::float64, radius);
  write_column(file, "chains/first", Hdf5Type::int64, first);
  write_column(file, "chains/ring", Hdf5Type::int8, ring);
}

/// Writes numbers of pairs of bins a chunk at once: HDF5 compresses a chunk that its cache has no room for
/// anew with every row.
template <class Value>
void write_matrix(Hdf5File& file, const std::string& name, std::size_t bins, const Value& value) {
  constexpr auto kEntries = static_cast<std::size_t>(kChunkEntries);
  const std::size_t rows = std::max<std::size_t>(1, kEntries / std::max<std::size_t>(1, bins));
  const auto columns = static_cast<std::int64_t>(bins);
  file.create_dataset(name, Hdf5Type::int64, columns, static_cast<std::int64_t>(rows));
  std::vector<std::int64_t> chunk;
  for (std::size_t first = 0; first < bins; first += rows) {
    const std::size_t last = std::min(bins, first + rows);
    chunk.clear();
    for (std::size_t a = first; a < last; ++a)
      for (std::size_t b = 0; b < bins; ++b) chunk.push_back(value(a, b));
    file.append(name, columns, chunk);
  }
}

void write_map(Hdf5File& file, const necklace::ContactMap& map) {
  file.create_group("map");
  const std::size_t bins = map.bins();
  std::vector<std::int64_t> first;
  for (std::size_t bin = 0; bin <= bins; ++bin) first.push_back(map.first_place(bin));
  write_column(file, "map/first_place", Hdf5Type::int64, first);
  write_matrix(file, "map/contacts", bins, [&](std::size_t a, std::size_t b) { return map.contacts(a, b); });
  write_matrix(file, "map/pairs", bins, [&](std::size_t a, std::size_t b) { return map.pairs(a, b); });
}

void write_probability(Hdf5File& file, const necklace::ContactProbability& probability) {
  file.create_group("separation");
  std::vector<double> values;
  for (std::size_t s = 0; s < probability.pairs().size(); ++s) values.push_back(probability.probability(s));
  const auto contacts = probability.contacts(), pairs = probability.pairs();
  write_column(file, "separation/contacts", Hdf5Type::int64,
               std::vector<std::int64_t>(contacts.begin(), contacts.end()));
  write_column(file, "separation/pairs", Hdf5Type::int64,
               std::vector<std::int64_t>(pairs.begin(), pairs.end()));
  write_column(file, "separation/probability", Hdf5Type::float64, values);
}

void describe(Hdf5File& file, const ContactFileHeader& header) {
  file.write_attribute("format", std::string("dch contacts 1"));
  file.write_attribute("creator", fmt::format("dchmd {}", kVersion));
  file.write_attribute("source", header.source);
  file.write_attribute("topology", header.topology);
  file.write_attribute("unit", header.unit);
  file.write_attribute("time", header.time);
  file.write_attribute("gap", header.query.gap);
  file.write_attribute("skip_bonds", std::int64_t{header.query.skip_bonds});
  file.write_attribute("pairs", std::string(pairs_text(header.query)));
}

}  // namespace

ContactFile::ContactFile(const std::string& path, const ContactFileHeader& header,
                         const necklace::Necklace& necklace, const std::vector<std::int64_t>& ids)
    : file_(path), ids_(ids) {
  file_.create_group("frames");
  for (const char* name : {"frame", "step", "within", "between"}) {
    create_column(file_, fmt::format("frames/{}", name), Hdf5Type::int64);
  }
  create_column(file_, "frames/time", Hdf5Type::float64);
  file_.create_group("events");
  for (const char* name : {"i", "j", "first", "frames"}) {
    create_column(file_, fmt::format("events/{}", name), Hdf5Type::int64);
  }
  for (const char* name : {"begin", "last"}) {
    create_column(file_, fmt::format("events/{}", name), Hdf5Type::float64);
  }
  for (const char* name : {"begun_before", "not_ended"}) {
    create_column(file_, fmt::format("events/{}", name), Hdf5Type::int8);
  }
  describe(file_, header);
  write_chains(file_, necklace, ids);
}

void ContactFile::append(const ContactFrame& frame) {
  const auto write = [&](const char* name, std::int64_t value) {
    file_.append(name, 0, std::vector<std::int64_t>{value});
  };
  write("frames/frame", frame.frame);
  write("frames/step", frame.step);
  write("frames/within", frame.within);
  write("frames/between", frame.between);
  const double time = frame.time.value_or(std::numeric_limits<double>::quiet_NaN());
  file_.append("frames/time", 0, std::vector<double>{time});
}

void ContactFile::append(Span<const necklace::ContactEvent> events) {
  const auto write = [&](const char* name, auto value) {
    std::vector<decltype(value(events[0]))> values;
    values.reserve(events.size());
    for (const necklace::ContactEvent& event : events) values.push_back(value(event));
    file_.append(name, 0, values);
  };
  using Event = necklace::ContactEvent;
  const auto id = [&](std::int32_t particle) { return ids_[static_cast<std::size_t>(particle)]; };
  write("events/i", [&](const Event& event) { return id(event.i); });
  write("events/j", [&](const Event& event) { return id(event.j); });
  write("events/first", [](const Event& event) { return event.first; });
  write("events/frames", [](const Event& event) { return event.frames; });
  write("events/begin", [](const Event& event) { return event.begin; });
  write("events/last", [](const Event& event) { return event.last; });
  write("events/begun_before", [](const Event& event) { return std::int64_t{event.begun_before}; });
  write("events/not_ended", [](const Event& event) { return std::int64_t{event.not_ended}; });
}

void ContactFile::finish(const necklace::ContactMap& map, const necklace::ContactProbability& probability) {
  write_map(file_, map);
  write_probability(file_, probability);
  file_.commit();
}

}  // namespace dch::cli

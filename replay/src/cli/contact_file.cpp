// SPDX-License-Identifier: MIT
#include "contact_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <hdf5.h>
#include <limits>

#include <dch/trajectory/file_error.hpp>

#include "hdf5_output.hpp"
#include "version.hpp"

namespace dch::cli {
namespace {

constexpr hsize_t kChunkRows = 1 << 13;

Hdf5Id column(hid_t group, const char* name, hid_t type) {
  return create_growing(group, name, type, 0, kChunkRows);
}

void append(hid_t data, const std::vector<std::int64_t>& values) {
  append_rows(data, H5T_NATIVE_INT64, values.size(), 0, values.data());
}
void append(hid_t data, const std::vector<double>& values) {
  append_rows(data, H5T_NATIVE_DOUBLE, values.size(), 0, values.data());
}

/// Writes a dataset of one axis at once.
template <class Values>
void write_column(hid_t group, const char* name, hid_t type, const Values& values) {
  Hdf5Id data = column(group, name, type);
  append(data, values);
  data.finish();
}

void write_chains(hid_t file, const necklace::Necklace& necklace, const std::vector<std::int64_t>& ids) {
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
  Hdf5Id group = create_group(file, "chains");
  write_column(group, "ids", H5T_STD_I64LE, order);
  write_column(group, "radius", H5T_IEEE_F64LE, radius);
  write_column(group, "first", H5T_STD_I64LE, first);
  write_column(group, "ring", H5T_STD_I8LE, ring);
  group.finish();
}

/// Writes numbers of pairs of bins a chunk at once: HDF5 compresses a chunk that its cache has no room for
/// anew with every row.
template <class Value>
void write_matrix(hid_t group, const char* name, std::size_t bins, const Value& value) {
  const std::size_t rows = std::max<std::size_t>(1, kChunkEntries / std::max<std::size_t>(1, bins));
  Hdf5Id data = create_growing(group, name, H5T_STD_I64LE, bins, rows);
  std::vector<std::int64_t> chunk;
  for (std::size_t first = 0; first < bins; first += rows) {
    const std::size_t last = std::min(bins, first + rows);
    chunk.clear();
    for (std::size_t a = first; a < last; ++a)
      for (std::size_t b = 0; b < bins; ++b) chunk.push_back(value(a, b));
    append_rows(data, H5T_NATIVE_INT64, last - first, bins, chunk.data());
  }
  data.finish();
}

void write_map(hid_t file, const necklace::ContactMap& map) {
  Hdf5Id group = create_group(file, "map");
  const std::size_t bins = map.bins();
  std::vector<std::int64_t> first;
  for (std::size_t bin = 0; bin <= bins; ++bin) first.push_back(map.first_place(bin));
  write_column(group, "first_place", H5T_STD_I64LE, first);
  write_matrix(group, "contacts", bins, [&](std::size_t a, std::size_t b) { return map.contacts(a, b); });
  write_matrix(group, "pairs", bins, [&](std::size_t a, std::size_t b) { return map.pairs(a, b); });
  group.finish();
}

void write_probability(hid_t file, const necklace::ContactProbability& probability) {
  Hdf5Id group = create_group(file, "separation");
  std::vector<double> values;
  for (std::size_t s = 0; s < probability.pairs().size(); ++s) values.push_back(probability.probability(s));
  const auto contacts = probability.contacts(), pairs = probability.pairs();
  write_column(group, "contacts", H5T_STD_I64LE, std::vector<std::int64_t>(contacts.begin(), contacts.end()));
  write_column(group, "pairs", H5T_STD_I64LE, std::vector<std::int64_t>(pairs.begin(), pairs.end()));
  write_column(group, "probability", H5T_IEEE_F64LE, values);
  group.finish();
}

}  // namespace

struct ContactFile::Datasets {
  Hdf5Id file;
  Hdf5Id frame, step, time, within, between;
  Hdf5Id i, j, first, frames, begin, last, begun_before, not_ended;

  explicit Datasets(const OutputFile& output) : file(create_hdf5(output)) {
    Hdf5Id frame_group = create_group(file, "frames");
    frame = column(frame_group, "frame", H5T_STD_I64LE);
    step = column(frame_group, "step", H5T_STD_I64LE);
    time = column(frame_group, "time", H5T_IEEE_F64LE);
    within = column(frame_group, "within", H5T_STD_I64LE);
    between = column(frame_group, "between", H5T_STD_I64LE);
    frame_group.finish();
    Hdf5Id event_group = create_group(file, "events");
    i = column(event_group, "i", H5T_STD_I64LE);
    j = column(event_group, "j", H5T_STD_I64LE);
    first = column(event_group, "first", H5T_STD_I64LE);
    frames = column(event_group, "frames", H5T_STD_I64LE);
    begin = column(event_group, "begin", H5T_IEEE_F64LE);
    last = column(event_group, "last", H5T_IEEE_F64LE);
    begun_before = column(event_group, "begun_before", H5T_STD_I8LE);
    not_ended = column(event_group, "not_ended", H5T_STD_I8LE);
    event_group.finish();
  }

  void describe(const ContactFileHeader& header) {
    write_attribute(file, "format", "dch contacts 1");
    write_attribute(file, "creator", fmt::format("dch {}", kVersion));
    write_attribute(file, "source", header.source);
    write_attribute(file, "topology", header.topology);
    write_attribute(file, "unit", header.unit);
    write_attribute(file, "time", header.time);
    write_attribute(file, "gap", header.query.gap);
    write_attribute(file, "skip_bonds", std::int64_t{header.query.skip_bonds});
    write_attribute(file, "pairs", pairs_text(header.query));
  }

  /// Closes everything; whether all of it went well, the last data on their way to the disk included.
  bool close() {
    bool closed = true;
    for (Hdf5Id* id : {&frame, &step, &time, &within, &between, &i, &j, &first, &frames, &begin, &last,
                       &begun_before, &not_ended, &file}) {
      closed = id->reset() >= 0 && closed;
    }
    return closed;
  }
};

ContactFile::ContactFile(const std::string& path, const ContactFileHeader& header,
                         const necklace::Necklace& necklace, const std::vector<std::int64_t>& ids)
    : file_(path), ids_(ids) {
  silence_hdf5();
  named(file_, [&] {
    datasets_ = std::make_unique<Datasets>(file_);
    datasets_->describe(header);
    write_chains(datasets_->file, necklace, ids);
  });
}

ContactFile::~ContactFile() = default;

void ContactFile::append(const ContactFrame& frame) {
  const double time = frame.time.value_or(std::numeric_limits<double>::quiet_NaN());
  named(file_, [&] {
    append_rows(datasets_->frame, H5T_NATIVE_INT64, 1, 0, &frame.frame);
    append_rows(datasets_->step, H5T_NATIVE_INT64, 1, 0, &frame.step);
    append_rows(datasets_->time, H5T_NATIVE_DOUBLE, 1, 0, &time);
    append_rows(datasets_->within, H5T_NATIVE_INT64, 1, 0, &frame.within);
    append_rows(datasets_->between, H5T_NATIVE_INT64, 1, 0, &frame.between);
  });
}

void ContactFile::append(Span<const necklace::ContactEvent> events) {
  const auto write = [&](hid_t data, auto value) {
    std::vector<decltype(value(events[0]))> values;
    values.reserve(events.size());
    for (const necklace::ContactEvent& event : events) values.push_back(value(event));
    cli::append(data, values);
  };
  using Event = necklace::ContactEvent;
  const auto id = [&](std::int32_t particle) { return ids_[static_cast<std::size_t>(particle)]; };
  named(file_, [&] {
    write(datasets_->i, [&](const Event& event) { return id(event.i); });
    write(datasets_->j, [&](const Event& event) { return id(event.j); });
    write(datasets_->first, [](const Event& event) { return event.first; });
    write(datasets_->frames, [](const Event& event) { return event.frames; });
    write(datasets_->begin, [](const Event& event) { return event.begin; });
    write(datasets_->last, [](const Event& event) { return event.last; });
    write(datasets_->begun_before, [](const Event& event) { return std::int64_t{event.begun_before}; });
    write(datasets_->not_ended, [](const Event& event) { return std::int64_t{event.not_ended}; });
  });
}

void ContactFile::finish(const necklace::ContactMap& map, const necklace::ContactProbability& probability) {
  named(file_, [&] {
    write_map(datasets_->file, map);
    write_probability(datasets_->file, probability);
  });
  if (!datasets_->close()) {
    throw trajectory::FileError(fmt::format("{}: cannot be completed; check the free space", file_.path()));
  }
  file_.commit();
}

}  // namespace dch::cli

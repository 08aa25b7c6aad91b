// SPDX-License-Identifier: MIT
#include "list_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <hdf5.h>

#include <dch/trajectory/file_error.hpp>

#include "hdf5_output.hpp"
#include "version.hpp"

namespace dch::cli {
struct ListFile::Datasets {
  Hdf5Id file, ids, first, neighbors, frame, step;

  Datasets(const OutputFile& output, const ListFileHeader& header) : file(create_hdf5(output)) {
    write_attribute(file, "format", "dch neighbor lists 1");
    write_attribute(file, "creator", fmt::format("dch {}", kVersion));
    write_attribute(file, "source", header.source);
    write_attribute(file, "unit", header.unit);
    write_attribute(file, "engine", header.engine);
    write_attribute(file, "exclusions", header.exclusions);
    write_attribute(file, "kind", header.kind == ListKind::half ? "half" : "full");
    write_attribute(file, "cutoff", header.cutoff);
    write_attribute(file, "skin", header.skin);
    ids = create_growing(file, "ids", H5T_STD_I64LE, std::max<hsize_t>(1, header.most_atoms), 1);
    first = create_growing(file, "first", H5T_STD_I64LE, header.most_atoms + 1, 1);
    neighbors = create_growing(file, "j", H5T_STD_I32LE, 0, kChunkEntries);
    frame = create_growing(file, "frame", H5T_STD_I64LE, 0, 1024);
    step = create_growing(file, "step", H5T_STD_I64LE, 0, 1024);
  }

  /// Closes everything; whether all of it went well, the last data on their way to the disk included.
  bool close() {
    bool closed = true;
    for (Hdf5Id* handle : {&ids, &first, &neighbors, &frame, &step, &file})
      closed = handle->reset() >= 0 && closed;
    return closed;
  }
};

ListFile::ListFile(const std::string& path, const ListFileHeader& header)
    : file_(path), most_atoms_(header.most_atoms) {
  silence_hdf5();
  datasets_ = named(file_, [&] { return std::make_unique<Datasets>(file_, header); });
}

ListFile::~ListFile() = default;

void ListFile::append(std::int64_t index, const trajectory::Frame& frame, const NeighborList& list,
                      bool is_new) {
  if (is_new || first_.empty()) {
    first_.assign(most_atoms_ + 1, entries_ + list.first.back());
    std::transform(list.first.begin(), list.first.end(), first_.begin(),
                   [this](std::int64_t begin) { return entries_ + begin; });
  }
  std::vector<std::int64_t> ids = frame.ids;
  ids.resize(std::max<std::size_t>(1, most_atoms_), -1);
  named(file_, [&] {
    append_rows(datasets_->ids, H5T_NATIVE_INT64, 1, ids.size(), ids.data());
    append_rows(datasets_->first, H5T_NATIVE_INT64, 1, first_.size(), first_.data());
    append_rows(datasets_->frame, H5T_NATIVE_INT64, 1, 0, &index);
    append_rows(datasets_->step, H5T_NATIVE_INT64, 1, 0, &frame.step);
    if (first_.back() == entries_) return;
    append_rows(datasets_->neighbors, H5T_NATIVE_INT32, list.j.size(), 0, list.j.data());
    entries_ = first_.back();
  });
}

void ListFile::commit() {
  if (!datasets_->close()) {
    throw trajectory::FileError(fmt::format("{}: cannot be completed; check the free space", file_.path()));
  }
  file_.commit();
}

}  // namespace dch::cli

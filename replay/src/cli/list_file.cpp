// SPDX-License-Identifier: MIT
#include "list_file.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <hdf5.h>
#include <utility>

#include <dch/trajectory/file_error.hpp>

#include "version.hpp"

namespace dch::cli {
namespace {

constexpr hsize_t kChunkEntries =
    1 << 18;  ///< of 4 or 8 bytes: about a megabyte, the size HDF5 caches by default
constexpr unsigned kDeflateLevel = 1;

/// Turns HDF5's own messages off: ours name file and remedy.
void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// An HDF5 identifier with the function that closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {
    if (id < 0) throw trajectory::FileError("an HDF5 object cannot be created");
  }
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  operator hid_t() const { return id_; }
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

void require(herr_t status) {
  if (status < 0) throw trajectory::FileError("HDF5 cannot write to it");
}

void write_attribute(hid_t object, const char* name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, H5T_VARIABLE));
  require(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* text = value.c_str();
  require(H5Awrite(attribute, type, &text));
}

void write_attribute(hid_t object, const char* name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
}

/// A compressed dataset that grows along its first axis; `columns` is 0 for one of a single axis.
Handle create_growing(hid_t file, const char* name, hid_t type, hsize_t columns, hsize_t chunk_rows) {
  const int rank = columns == 0 ? 1 : 2;
  const std::array<hsize_t, 2> size{0, columns};
  const std::array<hsize_t, 2> limit{H5S_UNLIMITED, columns};
  const std::array<hsize_t, 2> chunk{chunk_rows, std::min(columns, kChunkEntries)};
  const Handle space(H5Screate_simple(rank, size.data(), limit.data()), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(properties, rank, chunk.data()));
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    require(H5Pset_shuffle(properties));
    require(H5Pset_deflate(properties, kDeflateLevel));
  }
  return Handle(H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
}

/// Appends `rows` rows; `columns` as in create_growing.
void append_rows(hid_t data, hid_t memory_type, hsize_t rows, hsize_t columns, const void* values) {
  if (rows == 0) return;
  const int rank = columns == 0 ? 1 : 2;
  std::array<hsize_t, 2> start{0, 0};
  {
    const Handle space(H5Dget_space(data), H5Sclose);
    std::array<hsize_t, 2> size{};
    require(H5Sget_simple_extent_dims(space, size.data(), nullptr));
    start[0] = size[0];
  }
  const std::array<hsize_t, 2> size{start[0] + rows, columns};
  const std::array<hsize_t, 2> count{rows, columns};
  require(H5Dset_extent(data, size.data()));
  const Handle target(H5Dget_space(data), H5Sclose);
  require(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Handle source(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  require(H5Dwrite(data, memory_type, source, target, H5P_DEFAULT, values));
}

/// Names the file in errors of the HDF5 layer above.
template <class Action>
auto named(const OutputFile& file, Action action) {
  try {
    return action();
  } catch (const trajectory::FileError& error) {
    throw trajectory::FileError(
        fmt::format("{}: {}; check the free space and the folder's permissions", file.path(), error.what()));
  }
}

}  // namespace

struct ListFile::Datasets {
  Handle file, ids, first, neighbors, frame, step;

  Datasets(const OutputFile& output, const ListFileHeader& header)
      : file(H5Fcreate(output.temporary_path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {
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
    for (Handle* handle : {&ids, &first, &neighbors, &frame, &step, &file})
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

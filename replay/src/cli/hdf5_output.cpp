// SPDX-License-Identifier: MIT
#include "hdf5_output.hpp"

#include <algorithm>
#include <array>

namespace dch::cli {
namespace {

constexpr unsigned kDeflateLevel = 1;

void require(herr_t status) {
  if (status < 0) throw trajectory::FileError("HDF5 cannot write to it");
}

void write_scalar(hid_t object, const char* name, hid_t file_type, hid_t memory_type, const void* value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(H5Acreate2(object, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute, memory_type, value));
}

}  // namespace

void silence_hdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Hdf5Id::Hdf5Id(hid_t id, Close close) : id_(id), close_(close) {
  if (id < 0) throw trajectory::FileError("an HDF5 object cannot be created");
}

void Hdf5Id::finish() { require(reset()); }

Hdf5Id create_hdf5(const OutputFile& output) {
  return {H5Fcreate(output.temporary_path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose};
}

Hdf5Id create_group(hid_t parent, const char* name) {
  return {H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
}

void write_attribute(hid_t object, const char* name, const std::string& value) {
  const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, H5T_VARIABLE));
  require(H5Tset_cset(type, H5T_CSET_UTF8));
  const char* text = value.c_str();
  write_scalar(object, name, type, type, &text);
}

void write_attribute(hid_t object, const char* name, double value) {
  write_scalar(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(hid_t object, const char* name, std::int64_t value) {
  write_scalar(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

Hdf5Id create_growing(hid_t parent, const char* name, hid_t type, hsize_t columns, hsize_t chunk_rows) {
  const int rank = columns == 0 ? 1 : 2;
  const std::array<hsize_t, 2> size{0, columns};
  const std::array<hsize_t, 2> limit{H5S_UNLIMITED, columns};
  const std::array<hsize_t, 2> chunk{chunk_rows, std::min(columns, kChunkEntries)};
  const Hdf5Id space(H5Screate_simple(rank, size.data(), limit.data()), H5Sclose);
  const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(properties, rank, chunk.data()));
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    require(H5Pset_shuffle(properties));
    require(H5Pset_deflate(properties, kDeflateLevel));
  }
  return {H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose};
}

void append_rows(hid_t data, hid_t memory_type, hsize_t rows, hsize_t columns, const void* values) {
  if (rows == 0) return;
  const int rank = columns == 0 ? 1 : 2;
  std::array<hsize_t, 2> start{0, 0};
  {
    const Hdf5Id space(H5Dget_space(data), H5Sclose);
    std::array<hsize_t, 2> size{};
    require(H5Sget_simple_extent_dims(space, size.data(), nullptr));
    start[0] = size[0];
  }
  const std::array<hsize_t, 2> size{start[0] + rows, columns};
  const std::array<hsize_t, 2> count{rows, columns};
  require(H5Dset_extent(data, size.data()));
  const Hdf5Id target(H5Dget_space(data), H5Sclose);
  require(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Hdf5Id source(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  require(H5Dwrite(data, memory_type, source, target, H5P_DEFAULT, values));
}

}  // namespace dch::cli

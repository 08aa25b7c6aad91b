// SPDX-License-Identifier: MIT
#include "report/hdf5_output.hpp"

#include <algorithm>
#include <array>

#include <dch/trajectory/file_error.hpp>

namespace dch::cli {
namespace {

constexpr unsigned kDeflateLevel = 1;

void require(bool good) {
  if (!good) {
    throw trajectory::FileError(
        "HDF5 gives up; check the free space, the memory and the folder's permissions");
  }
}
void require(herr_t status) { require(status >= 0); }

hid_t stored(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::int8:
      return H5T_STD_I8LE;
    case Hdf5Type::int32:
      return H5T_STD_I32LE;
    case Hdf5Type::int64:
      return H5T_STD_I64LE;
    case Hdf5Type::float64:
      break;
  }
  return H5T_IEEE_F64LE;
}

hid_t in_memory(Hdf5Type type) {
  switch (type) {
    case Hdf5Type::int8:
      return H5T_NATIVE_INT8;
    case Hdf5Type::int32:
      return H5T_NATIVE_INT32;
    case Hdf5Type::int64:
      return H5T_NATIVE_INT64;
    case Hdf5Type::float64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

void write_scalar(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type,
                  const void* value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id attribute(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  require(H5Awrite(attribute, memory_type, value));
}

}  // namespace

Hdf5Id::Hdf5Id(hid_t id, Close close) : id_(id), close_(close) { require(id >= 0); }

Hdf5Output::Hdf5Output(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // its own messages name neither file nor remedy
  file_ = {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose};
}

void Hdf5Output::create_group(const std::string& name) {
  Hdf5Id group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  require(group.reset());
}

void Hdf5Output::write_attribute(const std::string& name, const std::string& value) {
  const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, H5T_VARIABLE));
  require(H5Tset_cset(type, H5T_CSET_UTF8));
  const char* text = value.c_str();
  write_scalar(file_, name, type, type, &text);
}

void Hdf5Output::write_attribute(const std::string& name, double value) {
  write_scalar(file_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Output::write_attribute(const std::string& name, std::int64_t value) {
  write_scalar(file_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Hdf5Output::create_dataset(const std::string& name, Hdf5Type type, std::int64_t columns,
                                std::int64_t chunk_rows) {
  const int rank = columns == 0 ? 1 : 2;
  const auto width = static_cast<hsize_t>(columns);
  const std::array<hsize_t, 2> size{0, width};
  const std::array<hsize_t, 2> limit{H5S_UNLIMITED, width};
  const std::array<hsize_t, 2> chunk{static_cast<hsize_t>(chunk_rows),
                                     std::min(width, static_cast<hsize_t>(kChunkEntries))};
  const Hdf5Id space(H5Screate_simple(rank, size.data(), limit.data()), H5Sclose);
  const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  require(H5Pset_chunk(properties, rank, chunk.data()));
  if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) {
    require(H5Pset_shuffle(properties));
    require(H5Pset_deflate(properties, kDeflateLevel));
  }
  datasets_[name] = {
      H5Dcreate2(file_, name.c_str(), stored(type), space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose};
}

void Hdf5Output::append(const std::string& name, Hdf5Type memory_type, std::int64_t rows,
                        std::int64_t columns, const void* values) {
  const Hdf5Id& data = datasets_.at(name);
  const int rank = columns == 0 ? 1 : 2;
  std::array<hsize_t, 2> start{0, 0};
  {
    const Hdf5Id space(H5Dget_space(data), H5Sclose);
    std::array<hsize_t, 2> size{};
    require(H5Sget_simple_extent_dims(space, size.data(), nullptr));
    start[0] = size[0];
  }
  const std::array<hsize_t, 2> count{static_cast<hsize_t>(rows), static_cast<hsize_t>(columns)};
  const std::array<hsize_t, 2> size{start[0] + count[0], count[1]};
  require(H5Dset_extent(data, size.data()));
  const Hdf5Id target(H5Dget_space(data), H5Sclose);
  require(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
  const Hdf5Id source(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  require(H5Dwrite(data, in_memory(memory_type), source, target, H5P_DEFAULT, values));
}

void Hdf5Output::close() {
  bool closed = true;
  for (auto& [name, data] : datasets_) closed = data.reset() >= 0 && closed;
  require(file_.reset() >= 0 && closed);
}

}  // namespace dch::cli

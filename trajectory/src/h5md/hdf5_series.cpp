// SPDX-License-Identifier: MIT
#include "h5md/hdf5_series.hpp"

#include <algorithm>

namespace dch::trajectory {

Hdf5Series::Hdf5Series(hid_t parent, const std::string& name, hid_t file_type,
                       const std::vector<hsize_t>& row_shape)
    : row_shape_(row_shape) {
  std::vector<hsize_t> size(row_shape), limit(row_shape), chunk(row_shape);
  size.insert(size.begin(), 0);
  limit.insert(limit.begin(), H5S_UNLIMITED);
  // A chunk holds one large row, or many small ones; HDF5 allows 4 GiB.
  constexpr hsize_t kMaxAtoms = hsize_t{1} << 20, kSmallRows = 512, kFewNumbers = 9;
  hsize_t numbers = 1;
  for (hsize_t& n : chunk) {
    n = std::min(n, kMaxAtoms);
    numbers *= n;
  }
  chunk.insert(chunk.begin(), numbers <= kFewNumbers ? kSmallRows : 1);

  const int rank = static_cast<int>(size.size());
  const Hdf5Handle space(H5Screate_simple(rank, size.data(), limit.data()));
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  if (H5Pset_chunk(properties.get(), rank, chunk.data()) < 0) return;
  dataset_ = Hdf5Handle(
      H5Dcreate2(parent, name.c_str(), file_type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT));
}

bool Hdf5Series::write(std::int64_t k, hid_t memory_type, const void* row) {
  if (!grow(k + 1)) return false;
  std::vector<hsize_t> start(row_shape_.size() + 1, 0), size(row_shape_);
  start[0] = static_cast<hsize_t>(k);
  size.insert(size.begin(), 1);
  const Hdf5Handle file_space(H5Dget_space(dataset_.get()));
  const Hdf5Handle memory_space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr));
  return H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) >=
             0 &&
         H5Dwrite(dataset_.get(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, row) >= 0;
}

bool Hdf5Series::grow(std::int64_t rows) {
  if (rows <= rows_) return true;
  std::vector<hsize_t> size(row_shape_);
  size.insert(size.begin(), static_cast<hsize_t>(rows));
  if (H5Dset_extent(dataset_.get(), size.data()) < 0) return false;
  rows_ = rows;
  return true;
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <vector>

namespace dch::cli {

/// All numbers of a data set, row by row.
inline std::vector<std::int64_t> read_integers(hid_t file, const char* name) {
  const hid_t data = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(data);
  std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(data);
  return values;
}

}  // namespace dch::cli

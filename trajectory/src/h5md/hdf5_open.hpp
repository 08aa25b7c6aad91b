// SPDX-License-Identifier: MIT
#pragma once

#include "files/input_file.hpp"
#include "h5md/hdf5_handle.hpp"

namespace dch::trajectory {

/// Opens an HDF5 file for reading through a descriptor that is open already: HDF5 opens nothing itself. Other
/// files that it asks for, since an external link names them, it does not get, and plugins for filters are
/// not loaded.
/// @param file must outlive the handle
/// @returns a handle that is not valid if it is no HDF5 file: hdf5_reason() tells why.
Hdf5Handle open_hdf5(const InputFile& file);

/// What leads from a dataset to the bytes of other files, in words for a message; empty if nothing does.
std::string hdf5_outside(hid_t dataset);

}  // namespace dch::trajectory

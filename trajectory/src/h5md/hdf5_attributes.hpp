// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>
#include <string>
#include <vector>

namespace dch::trajectory {

/// Writes a string attribute, as text of variable length in UTF-8: h5py takes no other for a Python string.
/// False if HDF5 fails.
bool write_attribute(hid_t object, const std::string& name, const std::string& text);
/// Likewise, an array of strings.
bool write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts);
/// Likewise, one integer or an array of them.
bool write_attribute(hid_t object, const std::string& name, int value);
bool write_attribute(hid_t object, const std::string& name, const std::vector<int>& values);

}  // namespace dch::trajectory

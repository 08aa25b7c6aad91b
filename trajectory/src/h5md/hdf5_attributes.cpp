// SPDX-License-Identifier: MIT
#include "h5md/hdf5_attributes.hpp"

#include "h5md/hdf5_handle.hpp"

namespace dch::trajectory {
namespace {

Hdf5Handle text_type() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle array_of(std::size_t count) {
  const hsize_t size = count;
  return Hdf5Handle(H5Screate_simple(1, &size, nullptr));
}

bool write(hid_t object, const std::string& name, hid_t type, const Hdf5Handle& space, const void* data) {
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT));
  return attribute.valid() && H5Awrite(attribute.get(), type, data) >= 0;
}

}  // namespace

bool write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Hdf5Handle type = text_type();
  const char* const data = text.c_str();
  return write(object, name, type.get(), Hdf5Handle(H5Screate(H5S_SCALAR)), &data);
}

bool write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& texts) {
  const Hdf5Handle type = text_type();
  std::vector<const char*> data;
  data.reserve(texts.size());
  for (const std::string& text : texts) data.push_back(text.c_str());
  return write(object, name, type.get(), array_of(data.size()), data.data());
}

bool write_attribute(hid_t object, const std::string& name, int value) {
  return write(object, name, H5T_NATIVE_INT, Hdf5Handle(H5Screate(H5S_SCALAR)), &value);
}

bool write_attribute(hid_t object, const std::string& name, const std::vector<int>& values) {
  return write(object, name, H5T_NATIVE_INT, array_of(values.size()), values.data());
}

}  // namespace dch::trajectory

// SPDX-License-Identifier: MIT
#include "h5md/hdf5_handle.hpp"

#include <stdexcept>

namespace dch::trajectory {
namespace {

herr_t keep_first(unsigned, const H5E_error2_t* error, void* text) {
  auto& reason = *static_cast<std::string*>(text);
  if (reason.empty() && error->desc != nullptr) reason = error->desc;
  return 0;
}

}  // namespace

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason.empty() ? "HDF5 gives no reason" : "HDF5: " + reason;
}

void hdf5_require(bool good, const std::string& what) {
  if (!good) throw std::runtime_error(what + " cannot be read; " + hdf5_reason());
}

Hdf5Lead hdf5_lead(hid_t parent, const std::string& name) {
  for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end), here = "'" + part + "'";
    const htri_t linked = H5Lexists(parent, part.c_str(), H5P_DEFAULT);
    hdf5_require(linked >= 0, here);
    if (linked == 0) return Hdf5Lead::nowhere;
    H5L_info_t link{};
    hdf5_require(H5Lget_info(parent, part.c_str(), &link, H5P_DEFAULT) >= 0, here);
    if (link.type == H5L_TYPE_EXTERNAL) return Hdf5Lead::outside;
    const htri_t leads = H5Oexists_by_name(parent, part.c_str(), H5P_DEFAULT);
    hdf5_require(leads >= 0, here);
    if (leads == 0) return Hdf5Lead::nowhere;
    if (end == std::string::npos) return Hdf5Lead::object;
    H5O_info_t object{};
    hdf5_require(H5Oget_info_by_name2(parent, part.c_str(), &object, H5O_INFO_BASIC, H5P_DEFAULT) >= 0, here);
    if (object.type != H5O_TYPE_GROUP) return Hdf5Lead::nowhere;
  }
}

}  // namespace dch::trajectory

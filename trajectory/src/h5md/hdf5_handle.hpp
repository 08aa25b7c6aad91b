// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>
#include <string>
#include <utility>

namespace dch::trajectory {

/// Owns an HDF5 identifier (file, group, dataset, ...), which HDF5 counts.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }
  /// Gives the identifier back; false if HDF5 could not do all that hangs on it (writing what it still
  /// holds).
  bool reset() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || H5Idec_ref(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// Keeps HDF5 from printing its errors, for the scope of the object.
class Hdf5Silence {
 public:
  Hdf5Silence() {
    H5Eget_auto2(H5E_DEFAULT, &printer_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, printer_, data_); }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t printer_ = nullptr;
  void* data_ = nullptr;
};

/// What HDF5 says about its last error: the description nearest to the cause.
std::string hdf5_reason();

/// @throws std::runtime_error, with HDF5's reason, if what is named could not be read.
void hdf5_require(bool good, const std::string& what);

enum class Hdf5Lead { nowhere, object, outside };

/// Where the path `name` leads from `parent`: to an object, to another file, or nowhere.
/// @throws std::runtime_error if that cannot be found out: what cannot be read is not absent.
Hdf5Lead hdf5_lead(hid_t parent, const std::string& name);

}  // namespace dch::trajectory

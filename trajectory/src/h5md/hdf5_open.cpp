// SPDX-License-Identifier: MIT
#include "h5md/hdf5_open.hpp"

#include <H5FDpublic.h>
#include <H5PLpublic.h>
#include <algorithm>
#include <exception>
#include <memory>

namespace dch::trajectory {
namespace {

/// Handed to HDF5 with the property list.
struct Source {
  const InputFile* file;
};

/// HDF5 takes a pointer to the first member for the whole, as C does.
struct OpenFile {
  H5FD_t common;
  const InputFile* file;
  haddr_t end_of_addresses;
};

OpenFile* of(H5FD_t* file) { return reinterpret_cast<OpenFile*>(file); }
const OpenFile* of(const H5FD_t* file) { return reinterpret_cast<const OpenFile*>(file); }

H5FD_t* open(const char* name, unsigned flags, hid_t properties, haddr_t) {
  const auto* source = static_cast<const Source*>(H5Pget_driver_info(properties));
  const bool writes = (flags & (H5F_ACC_RDWR | H5F_ACC_TRUNC | H5F_ACC_CREAT)) != 0;
  if (source == nullptr || writes || source->file->path() != name) return nullptr;  // a link out of the file
  return &(new OpenFile{H5FD_t{}, source->file, 0})->common;
}

herr_t close(H5FD_t* file) {
  delete of(file);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  if (of(a)->file == of(b)->file) return 0;
  return std::less<>()(of(a)->file, of(b)->file) ? -1 : 1;
}

herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE;
  return 0;
}

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return of(file)->end_of_addresses; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  of(file)->end_of_addresses = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return static_cast<haddr_t>(of(file)->file->size()); }

/// What lies behind the end of the file is zeros, as with HDF5's own drivers.
herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) try {
  const auto end = static_cast<haddr_t>(of(file)->file->size());
  const auto offset = static_cast<std::int64_t>(std::min(address, end));
  const std::size_t got = of(file)->file->read_at(offset, buffer, size);
  std::fill_n(static_cast<char*>(buffer) + got, size - got, '\0');
  return 0;
} catch (const std::exception&) {
  return -1;
}

herr_t write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) { return -1; }

H5FD_class_t make_driver() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
  driver.version = H5FD_CLASS_VERSION;  // from HDF5 1.14 on
#endif
  driver.name = "dch-descriptor";
  driver.maxaddr = HADDR_MAX;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Source);
  driver.open = open;
  driver.close = close;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = end_of_file;
  driver.read = read;
  driver.write = write;
  const H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(free_lists), std::end(free_lists), driver.fl_map);
  return driver;
}

}  // namespace

Hdf5Handle open_hdf5(const InputFile& file) {
  H5PLset_loading_state(0);
  static const H5FD_class_t driver = make_driver();
  const Hdf5Handle registered(H5FDregister(&driver));
  const Hdf5Handle properties(H5Pcreate(H5P_FILE_ACCESS));
  const Source source{&file};
  if (H5Pset_driver(properties.get(), registered.get(), &source) < 0) return Hdf5Handle();
  return Hdf5Handle(H5Fopen(file.path().c_str(), H5F_ACC_RDONLY, properties.get()));
}

std::string hdf5_outside(hid_t dataset) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset));
  if (H5Pget_external_count(properties.get()) > 0)
    return "keeps its numbers in other files (external storage)";
  if (H5Pget_layout(properties.get()) == H5D_VIRTUAL)
    return "is put together from other files (virtual dataset)";
  return {};
}

}  // namespace dch::trajectory

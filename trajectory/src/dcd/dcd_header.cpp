// SPDX-License-Identifier: MIT
#include "dcd/dcd_header.hpp"

#include <cstring>
#include <fmt/format.h>
#include <string>

#include "base/byte_order.hpp"
#include "base/place.hpp"
#include "files/record_file.hpp"

namespace dch::trajectory {
namespace {

constexpr double kAkma = 0.0488882129;     ///< CHARMM's unit of time [ps]
constexpr std::int32_t kControlSize = 84;  ///< "CORD" and 20 integers

/// The length of the first record is known, so it tells the byte order.
std::endian find_order(const InputFile& file) {
  char head[12] = {};
  file.read_at(0, head, sizeof head);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    if (decode<std::int32_t>(head, order) == kControlSize) {
      if (std::memcmp(head + 4, "CORD", 4) == 0) return order;
      if (std::memcmp(head + 4, "VELD", 4) == 0) {
        fail_at_byte(file.path(), 0, 4, "the DCD file holds velocities (VELD), not coordinates (CORD)");
      }
    }
    if (decode<std::int64_t>(head, order) == kControlSize && std::memcmp(head + 8, "CORD", 4) == 0) {
      fail_at_byte(file.path(), 0, 0,
                   "DCD files with 64-bit record lengths are not supported; convert it to 32-bit");
    }
  }
  fail_at_byte(file.path(), 0, 0, "expected the start of a DCD file: a record of 84 bytes with 'CORD'");
}

/// The 20 integers behind "CORD".
class Control {
 public:
  Control(const std::vector<unsigned char>& record, std::endian order) : record_(record), order_(order) {}
  template <class T = std::int32_t>
  T get(std::size_t k) const {
    return decode<T>(record_.data() + 4 + 4 * k, order_);
  }

 private:
  const std::vector<unsigned char>& record_;
  std::endian order_;
};

std::vector<std::int32_t> read_free_atoms(RecordFile& records, const DcdHeader& header, std::int32_t fixed) {
  if (fixed == 0) return {};
  if (fixed < 0 || fixed >= header.atoms) {
    records.fail_here(
        fmt::format("expected fewer fixed atoms than the {} atoms, found {}", header.atoms, fixed));
  }
  const std::int64_t count = header.atoms - fixed;
  const auto& data = records.next("the list of free atoms", 4 * count);
  std::vector<std::int32_t> free_atoms;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const auto index = decode<std::int32_t>(data.data() + 4 * k, header.order);
    if (index < 1 || index > header.atoms) {
      records.fail_here(fmt::format("the list of free atoms names atom {} of {}", index, header.atoms));
    }
    free_atoms.push_back(index - 1);
  }
  return free_atoms;
}

}  // namespace

DcdHeader read_dcd_header(const InputFile& file) {
  DcdHeader header;
  header.order = find_order(file);
  RecordFile records(file);
  records.set_order(header.order);

  const Control control(records.next("the DCD header", kControlSize), header.order);
  header.first_step = control.get(1);
  header.step_interval = control.get(2);
  const auto fixed = control.get(8);
  const bool charmm =
      control.get(19) != 0;  // X-PLOR leaves the version 0, has no cell, and writes a double here
  header.time_step = kAkma * (charmm ? static_cast<double>(control.get<float>(9)) : control.get<double>(9));
  header.has_cell = charmm && control.get(10) != 0;
  header.has_fourth_dimension = charmm && control.get(11) != 0;

  records.next("the DCD title");
  header.atoms = decode<std::int32_t>(records.next("the number of atoms", 4).data(), header.order);
  if (header.atoms <= 0)
    records.fail_here(fmt::format("expected a number of atoms above 0, found {}", header.atoms));
  header.free_atoms = read_free_atoms(records, header, fixed);
  header.size = records.offset();
  return header;
}

}  // namespace dch::trajectory

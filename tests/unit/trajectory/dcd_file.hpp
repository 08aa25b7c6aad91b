// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace dch::trajectory::test {

/// Builds DCD files byte by byte.
class DcdFile {
 public:
  explicit DcdFile(std::endian order = std::endian::little) : order_(order) {}

  std::int32_t atoms = 2;
  std::int32_t frames = 1;
  std::int32_t first_step = 100;
  std::int32_t interval = 10;
  std::int32_t version = 24;  ///< 0 is X-PLOR's
  bool has_cell = false;
  bool has_fourth_dimension = false;
  std::string kind = "CORD";
  std::vector<std::int32_t> free_atoms;  ///< from 1; empty: all are free

  void append_header() {
    std::string control = kind;
    std::array<std::int32_t, 20> numbers{};
    numbers[0] = frames;
    numbers[1] = first_step;
    numbers[2] = interval;
    numbers[8] = free_atoms.empty() ? 0 : atoms - static_cast<std::int32_t>(free_atoms.size());
    numbers[10] = has_cell;
    numbers[11] = has_fourth_dimension;
    numbers[19] = version;
    for (const std::int32_t number : numbers) control += encode(number);
    const double half_unit_of_time = 0.5;
    if (version == 0) {
      control.replace(4 + 4 * 9, 8, encode(half_unit_of_time));
    } else {
      control.replace(4 + 4 * 9, 4, encode(static_cast<float>(half_unit_of_time)));
    }
    append_record(control);
    append_record(encode(std::int32_t{1}) + std::string(80, ' '));
    append_record(encode(atoms));
    std::string free_list;
    for (const std::int32_t atom : free_atoms) free_list += encode(atom);
    if (!free_list.empty()) append_record(free_list);
  }

  void append_cell(const std::array<double, 6>& numbers) {
    std::string record;
    for (const double number : numbers) record += encode(number);
    append_record(record);
  }

  void append_coordinates(const std::vector<float>& values) {
    std::string record;
    for (const float value : values) record += encode(value);
    append_record(record);
  }

  void append_record(const std::string& data) {
    const std::string length = encode(static_cast<std::int32_t>(data.size()));
    bytes_ += length + data + length;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  std::string encode(T value) const {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    return order_ == std::endian::native ? std::string(raw.begin(), raw.end())
                                         : std::string(raw.rbegin(), raw.rend());
  }

  std::endian order_;
  std::string bytes_;
};

}  // namespace dch::trajectory::test

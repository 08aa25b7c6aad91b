// SPDX-License-Identifier: MIT
#include "files/file_name.hpp"

#include <algorithm>
#include <filesystem>

namespace dch::trajectory {

std::string lower_case_name(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::transform(name.begin(), name.end(), name.begin(), lower);
  return name;
}

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending;
}

}  // namespace dch::trajectory

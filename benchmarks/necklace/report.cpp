// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include <dch/base/error.hpp>

namespace dch::bench {

namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void require_same(bool same, const std::string& what) {
  if (!same) throw Error(what + " differ: nothing is measured before the answers agree");
}

void write_json(const std::string& path, const Table& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Row& row : table) {
    nlohmann::ordered_json object;
    for (const auto& [name, value] : row) {
      std::visit([&, &key = name](const auto& v) { object[key] = v; }, value);
    }
    rows.push_back(object);
  }
  const nlohmann::ordered_json file{{"processor", processor()}, {"compiler", __VERSION__}, {"table", rows}};
  std::ofstream out(path);
  out << file.dump(1) << '\n';
  if (!out.flush()) throw Error(path + ": cannot be written; check the folder and the free space");
}

}  // namespace dch::bench

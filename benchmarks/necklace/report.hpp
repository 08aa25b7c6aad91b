// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dch::bench {

/// Named values of one line of a table.
using Row = std::vector<std::pair<std::string, std::variant<double, std::string>>>;
using Table = std::vector<Row>;

double median_of(std::vector<double> values);

/// Ends a benchmark whose answer is wrong. @throws Error unless `same`.
void require_same(bool same, const std::string& what);

/// Writes the table with processor and compiler. @throws Error if the file cannot be written.
void write_json(const std::string& path, const Table& table);

}  // namespace dch::bench

// SPDX-License-Identifier: MIT
#include "lammps/dump_columns.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/text.hpp"

namespace dch::trajectory {
namespace {

using Role = DumpColumns::Role;

struct CoordinateSet {
  std::array<std::string_view, 3> names;
  bool scaled;
  bool unwrapped;
};

constexpr CoordinateSet kCoordinateSets[] = {
    {{"x", "y", "z"}, false, false},
    {{"xu", "yu", "zu"}, false, true},
    {{"xs", "ys", "zs"}, true, false},
    {{"xsu", "ysu", "zsu"}, true, true},
};

/// The names in their order, and where to find one.
class ColumnNames {
 public:
  explicit ColumnNames(std::string_view text) {
    for (std::string_view word; next_word(text, word);) names_.push_back(word);
  }
  std::size_t size() const { return names_.size(); }
  bool has(std::string_view name) const { return find(name) != names_.end(); }
  bool has_all(const std::array<std::string_view, 3>& wanted) const {
    return std::all_of(wanted.begin(), wanted.end(), [this](std::string_view name) { return has(name); });
  }
  std::size_t index(std::string_view name) const {
    return static_cast<std::size_t>(std::distance(names_.begin(), find(name)));
  }
  /// A name that occurs twice, or an empty one. A line of 1 MiB may hold hundreds of thousands of names.
  std::string_view repeated() const {
    std::vector<std::string_view> sorted(names_);
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    return twice == sorted.end() ? std::string_view() : *twice;
  }

 private:
  std::vector<std::string_view>::const_iterator find(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name);
  }
  std::vector<std::string_view> names_;
};

}  // namespace

std::string parse_dump_columns(std::string_view names, DumpColumns& columns) {
  columns = DumpColumns();
  const ColumnNames have(names);
  if (const auto twice = have.repeated(); !twice.empty())
    return "the column " + in_quotes(twice) + " appears twice";
  columns.roles.assign(have.size(), Role::ignored);

  const auto* set = std::find_if(std::begin(kCoordinateSets), std::end(kCoordinateSets),
                                 [&](const CoordinateSet& s) { return have.has_all(s.names); });
  if (set == std::end(kCoordinateSets)) {
    return "no complete set of coordinate columns (x y z, xu yu zu, xs ys zs or xsu ysu zsu) in " +
           in_quotes(names);
  }
  columns.scaled = set->scaled;
  columns.unwrapped = set->unwrapped;

  const auto assign = [&](std::string_view name, Role role) { columns.roles[have.index(name)] = role; };
  assign(set->names[0], Role::x);
  assign(set->names[1], Role::y);
  assign(set->names[2], Role::z);
  columns.has_id = have.has("id");
  if (columns.has_id) assign("id", Role::id);
  columns.has_molecule = have.has("mol");
  if (columns.has_molecule) assign("mol", Role::molecule);
  columns.has_type = have.has("type");
  if (columns.has_type) assign("type", Role::type);
  columns.has_images = !set->unwrapped && have.has_all({"ix", "iy", "iz"});
  if (columns.has_images) {
    assign("ix", Role::ix);
    assign("iy", Role::iy);
    assign("iz", Role::iz);
  }
  return {};
}

}  // namespace dch::trajectory

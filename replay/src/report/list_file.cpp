// SPDX-License-Identifier: MIT
#include "report/list_file.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/version.hpp"

namespace dch::cli {

ListFile::ListFile(const std::string& path, const ListFileHeader& header)
    : file_(path), most_atoms_(header.most_atoms) {
  file_.write_attribute("format", std::string("dch neighbor lists 1"));
  file_.write_attribute("creator", fmt::format("dchmd {}", kVersion));
  file_.write_attribute("source", header.source);
  file_.write_attribute("unit", header.unit);
  file_.write_attribute("engine", header.engine);
  file_.write_attribute("exclusions", header.exclusions);
  file_.write_attribute("kind", std::string(header.kind == ListKind::half ? "half" : "full"));
  file_.write_attribute("cutoff", header.cutoff);
  file_.write_attribute("skin", header.skin);
  const auto most = static_cast<std::int64_t>(most_atoms_);
  file_.create_dataset("ids", Hdf5Type::int64, std::max<std::int64_t>(1, most), 1);
  file_.create_dataset("first", Hdf5Type::int64, most + 1, 1);
  file_.create_dataset("j", Hdf5Type::int32, 0, kChunkEntries);
  file_.create_dataset("frame", Hdf5Type::int64, 0, 1024);
  file_.create_dataset("step", Hdf5Type::int64, 0, 1024);
  if (!header.continuous) return;
  file_.create_group("between");
  file_.create_dataset("between/frames", Hdf5Type::int64, 2, 1024);
  file_.create_dataset("between/followed", Hdf5Type::int8, 0, 1024);
  for (const char* name : {"interval", "i", "j"})
    file_.create_dataset(fmt::format("between/{}", name), Hdf5Type::int64, 0, kChunkEntries);
  for (const char* name : {"enters", "leaves", "closest"})
    file_.create_dataset(fmt::format("between/{}", name), Hdf5Type::float64, 0, kChunkEntries);
  file_.create_dataset("between/hidden", Hdf5Type::int8, 0, kChunkEntries);
}

void ListFile::append(std::int64_t index, const trajectory::Frame& frame, const NeighborList& list,
                      bool is_new) {
  if (is_new || first_.empty()) {
    first_.assign(most_atoms_ + 1, entries_ + list.first.back());
    std::transform(list.first.begin(), list.first.end(), first_.begin(),
                   [this](std::int64_t begin) { return entries_ + begin; });
  }
  std::vector<std::int64_t> ids = frame.ids;
  ids.resize(std::max<std::size_t>(1, most_atoms_), -1);
  file_.append("ids", static_cast<std::int64_t>(ids.size()), ids);
  file_.append("first", static_cast<std::int64_t>(first_.size()), first_);
  file_.append("frame", 0, std::vector<std::int64_t>{index});
  file_.append("step", 0, std::vector<std::int64_t>{frame.step});
  if (first_.back() == entries_) return;
  file_.append("j", 0, list.j);
  entries_ = first_.back();
}

void ListFile::append(const IntervalRecord& interval, const std::vector<BetweenContact>& contacts) {
  file_.append("between/frames", 2, std::vector<std::int64_t>{interval.frame, interval.next_frame});
  file_.append("between/followed", 0, std::vector<std::int32_t>{interval.undetermined.empty() ? 1 : 0});
  const std::int64_t number = intervals_++;
  if (contacts.empty()) return;
  const auto write = [&](const char* name, auto value) {
    std::vector<decltype(value(contacts[0]))> values;
    values.reserve(contacts.size());
    for (const BetweenContact& contact : contacts) values.push_back(value(contact));
    file_.append(fmt::format("between/{}", name), 0, values);
  };
  write("interval", [&](const BetweenContact&) { return number; });
  write("i", [](const BetweenContact& contact) { return contact.i; });
  write("j", [](const BetweenContact& contact) { return contact.j; });
  write("enters", [](const BetweenContact& contact) { return contact.enters; });
  write("leaves", [](const BetweenContact& contact) { return contact.leaves; });
  write("closest", [](const BetweenContact& contact) { return contact.closest; });
  write("hidden", [](const BetweenContact& contact) -> std::int32_t { return contact.is_hidden ? 1 : 0; });
}

void ListFile::commit() { file_.commit(); }

}  // namespace dch::cli

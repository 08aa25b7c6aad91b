// SPDX-License-Identifier: GPL-2.0-or-later
#include "restart_numbers.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <error.h>
#include <map>

namespace LAMMPS_NS {
namespace {

/// What a function writes to a file.
template <class Write>
std::string written(const Write& write) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* const file = open_memstream(&text, &size);
  if (!file) return {};
  write(file);
  std::fclose(file);
  std::string all(text, size);
  std::free(text);
  return all;
}

/// Has a style take these pairs of types for given ones while it lives, and no others.
class AsIfGiven {
 public:
  AsIfGiven(Pair& style, int types, const std::vector<std::pair<int, int>>& pairs)
      : style_(style), types_(types) {
    each([&](int& flag) { before_.push_back(std::exchange(flag, 0)); });
    for (const auto& [a, b] : pairs) style.setflag[a][b] = 1;
  }
  ~AsIfGiven() {
    std::size_t k = 0;
    each([&](int& flag) { flag = before_[k++]; });
  }
  AsIfGiven(const AsIfGiven&) = delete;
  AsIfGiven& operator=(const AsIfGiven&) = delete;

 private:
  template <class Visit>
  void each(const Visit& visit) {
    for (int a = 1; a <= types_; ++a)
      for (int b = a; b <= types_; ++b) visit(style_.setflag[a][b]);
  }

  Pair& style_;
  int types_;
  std::vector<int> before_;
};

}  // namespace

std::string restart_settings(Pair& style) {
  return written([&](std::FILE* file) { style.write_restart_settings(file); });
}

RestartNumbers::RestartNumbers(Pair& style, const std::string& name, int types, int own,
                               const std::vector<std::pair<int, int>>& pairs, Error& error) {
  const std::string settings = restart_settings(style);
  all_.resize(settings.size() / sizeof(double));
  std::memcpy(all_.data(), settings.data(), all_.size() * sizeof(double));
  std::string whole;
  {
    const AsIfGiven as_if(style, types, pairs);
    whole = written([&](std::FILE* file) { style.write_restart(file); });
  }
  const std::size_t bytes = static_cast<std::size_t>(own) * sizeof(double);
  const std::size_t all_pairs = static_cast<std::size_t>(types) * (static_cast<std::size_t>(types) + 1) / 2;
  if (whole.size() != settings.size() + all_pairs * sizeof(int) + pairs.size() * bytes) {
    error.one(FLERR, "Pair style " + name + "/dch does not know the restart data of this LAMMPS's style " +
                         name + "; use that");
  }
  std::map<std::pair<int, int>, std::size_t> order;
  for (std::size_t k = 0; k < pairs.size(); ++k) order[pairs[k]] = k;
  of_pairs_.assign(pairs.size(), std::vector<double>(static_cast<std::size_t>(own)));
  const char* from = whole.data() + settings.size();
  for (int a = 1; a <= types; ++a) {
    for (int b = a; b <= types; ++b) {
      from += sizeof(int);
      const auto found = order.find({a, b});
      if (found == order.end()) continue;
      std::memcpy(of_pairs_[found->second].data(), from, bytes);
      from += bytes;
    }
  }
}

}  // namespace LAMMPS_NS

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>

namespace dch::cli {

enum class EngineKind { dch, grid, automatic, cell, allpairs };

/// Whether the engine keeps a hierarchy, at least at times.
inline bool may_keep_hierarchy(EngineKind kind) {
  return kind == EngineKind::dch || kind == EngineKind::automatic;
}
/// Whether it can work with several threads.
inline bool takes_threads(EngineKind kind) { return may_keep_hierarchy(kind) || kind == EngineKind::grid; }

/// What a replay's engine is made from.
struct EngineOptions {
  EngineKind kind = EngineKind::dch;
  MaintenancePolicy policy = MaintenancePolicy::automatic;  ///< repair or rebuild (dch, auto)
};

std::string to_string(EngineKind kind);           ///< as on the command line: "dch", "grid", "auto", ..
std::string to_string(MaintenancePolicy policy);  ///< "auto", "repair", "rebuild"

/// An engine, and whether it keeps a hierarchy.
struct Engine {
  std::unique_ptr<Executor> threads;   ///< that search works with; null for one
  std::unique_ptr<PairSearch> search;  ///< its times cover update() and list() of every kind alike
  bool keeps_hierarchy = false;        ///< at least at times
};

/// @param radius cutoff + skin of the lists to come [length]
/// @param threads to work with; null for one (dch, grid, auto)
/// @throws InvalidParameter for a radius out of range.
Engine make_engine(const EngineOptions& options, double radius, std::unique_ptr<Executor> threads = nullptr);

/// Lets lists that come and go, as atoms do, use one engine that stays.
/// @param keys name the atoms to every update() (see PairSearch); empty: by their index
std::unique_ptr<PairSearch> borrow(PairSearch& engine, std::vector<std::uint64_t> keys);

}  // namespace dch::cli

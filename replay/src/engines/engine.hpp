// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>

namespace dch::cli {

enum class EngineKind { dch, cell, allpairs };

/// What a replay's engine is made from.
struct EngineOptions {
  EngineKind kind = EngineKind::dch;
  MaintenancePolicy policy = MaintenancePolicy::automatic;  ///< repair or rebuild (dch only)
};

std::string to_string(EngineKind kind);           ///< as on the command line: "dch", "cell", "allpairs"
std::string to_string(MaintenancePolicy policy);  ///< "auto", "repair", "rebuild"

/// An engine, and whether it keeps a hierarchy.
struct Engine {
  std::unique_ptr<Executor> threads;   ///< that search works with; null for one
  std::unique_ptr<PairSearch> search;  ///< its times cover update() and list() of every kind alike
  bool keeps_hierarchy = false;        ///< not so for cell and allpairs
};

/// @param radius cutoff + skin of the lists to come [length]
/// @param threads to work with; null for one (dch only)
/// @throws InvalidParameter for a radius out of range.
Engine make_engine(const EngineOptions& options, double radius, std::unique_ptr<Executor> threads = nullptr);

/// Lets lists that come and go, as atoms do, use one engine that stays.
/// @param keys name the atoms to every update() (see PairSearch); empty: by their index
std::unique_ptr<PairSearch> borrow(PairSearch& engine, std::vector<std::uint64_t> keys);

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>

namespace dch::bench {

/// Times of one contender on one scene, in ns for one particle and all its lists of one configuration.
struct Measurement {
  std::string contender;
  std::vector<double> ns;         ///< by repetition: mean over the configurations after the first
  std::vector<double> update_ns;  ///< the part of it that Contender::update() takes, 0 if it keeps nothing
  double first_ns = 0;            ///< least time of the first configuration: build and lists
  double bytes = 0;               ///< held beyond the lists, by particle
  std::string choice;             ///< Contender::choice() at the end of the last repetition
  bool keeps_structure = false;
  SearchStats stats;  ///< of the last repetition, if it keeps a structure

  double median() const;
  double least() const;
};

struct SceneResult {
  std::string scene, origin;
  std::size_t particles = 0;
  double pairs = 0;             ///< by particle, all lists together
  std::uint64_t list_hash = 0;  ///< CheckedLists::last_hash
  int lists = 0;                ///< timed configurations of one repetition
  std::vector<Measurement> measurements;

  /// The measurement of that name, or null.
  const Measurement* find(const std::string& contender) const;
  /// The fastest of those that keep no structure and have no choice, or null.
  const Measurement* best_grid() const;
  /// The engine that `auto` took at last ("dch" or "grid"), over the faster of the two; 0 if one is missing.
  double choice_over_best() const;
};

/// Median over the repetitions of time a over time b, both of the same repetition.
double median_ratio(const Measurement& a, const Measurement& b);

void print_scene(const SceneResult& result);
/// One line for each scene: the hierarchy against the best grid; and the engine that chooses against both.
void print_summary(const std::vector<SceneResult>& results);
/// @throws Error if the file cannot be written.
void write_json(const std::string& path, const std::vector<SceneResult>& results);

}  // namespace dch::bench

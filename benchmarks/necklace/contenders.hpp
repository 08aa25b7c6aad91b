// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/vec3.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/necklace/contacts.hpp>

namespace dch::bench {

/// One chain in open space, where its beads are at two times, and what is asked.
struct QueryScene {
  std::string name;
  std::vector<Vec3> frames[2];
  double radius;
  double gap;
  bool yes_or_no;                ///< is there any contact? else: all of them. Of bonded beads none counts
  Executor* executor = nullptr;  ///< threads to search on, for those that can

  necklace::Necklace necklace() const;
  necklace::ContactQuery query() const { return {gap, 1, true, true}; }
  double reach() const { return 2 * radius + gap; }
};

/// A structure that finds contacts.
class Contender {
 public:
  virtual ~Contender() = default;
  virtual std::string name() const = 0;
  /// Takes new positions.
  virtual void update(const std::vector<Vec3>& positions) = 0;
  /// What the scene asks for: the number of contacts, or 1 if there is any and 0 if not.
  virtual std::int64_t ask() = 0;
  /// All contacts, i < j, in any order; to be checked, not timed.
  virtual std::vector<IndexPair> contacts() = 0;
  /// Whether it can name all contacts; else only the answer to the yes/no question is checked.
  virtual bool lists() const { return true; }
  /// What it says of itself.
  virtual std::string note() const { return ""; }
};

/// Cell list, DCH, wrapped hierarchy kept up and built anew, layered hierarchy, what the scene choice takes
/// and, for a yes/no question, the power diagram.
std::vector<std::unique_ptr<Contender>> make_contenders(const QueryScene& scene);

}  // namespace dch::bench

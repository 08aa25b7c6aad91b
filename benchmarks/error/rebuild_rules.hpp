// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

namespace dch::bench {

/// When a list is made anew.
class RebuildRule {
 public:
  virtual ~RebuildRule() = default;

  /// Asked once at every step, after atoms have moved.
  virtual bool is_due(const std::vector<Vec3>& positions, const Box& box) = 0;
  /// A list is being made of these positions.
  virtual void remember(const std::vector<Vec3>& positions, const Box& box) = 0;
  /// Whether it says that no pair within the cutoff is ever missing.
  virtual bool is_certified() const { return false; }
};

/// A rule by its name:
///   certified  StaleTest, which VerletList and the adapters go by;
///   every:N    every N steps, whatever has moved, as GROMACS does (nstlist);
///   openmm     that of OpenMM 7.7's CPU platform (CpuKernels.cpp): due once an atom has moved more than
///              skin / sqrt(2), or more than a tenth of them more than skin / 2; and once two of the latter,
///              which were farther apart than cutoff + skin, are within the cutoff, images not looked at.
/// @param skin beyond the cutoff, OpenMM's padding [length]
/// @throws Error for another name
std::unique_ptr<RebuildRule> make_rebuild_rule(const std::string& name, double cutoff, double skin);

/// For people: "every 20 steps".
std::string title_of_rule(const std::string& name);

}  // namespace dch::bench

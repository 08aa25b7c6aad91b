// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/kinetic/kinetic_edges.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// What a kinetic hierarchy did and holds: the four qualities of a kinetic data structure (thesis 5.5.2), as
/// counted.
struct KineticCounters {
  // Efficiency: the events of the structure beside those of the edges of level 0.
  std::int64_t external = 0;      ///< edges of level 0 that came or went
  std::int64_t upper_edges = 0;   ///< the same of higher levels
  std::int64_t lost_parents = 0;  ///< nodes that left the ball of their parent
  std::int64_t demotions = 0;     ///< nodes that came too close to another of their level
  std::int64_t renewals = 0;      ///< periodic boxes: looked ahead as far as the images allow, and once more
  // Compactness
  std::int64_t certificates = 0;       ///< now
  std::int64_t most_certificates = 0;  ///< at any time since the start
  // Responsiveness
  std::int64_t made = 0;  ///< certificates made or predicted anew by all events and changes of plan
  std::int64_t most_made_by_one = 0;  ///< by one event or one change of plan

  std::int64_t events() const { return external + upper_edges + lost_parents + demotions; }
};

/// The kinetic DCH of thesis 5.5.1, with its four certificates, for proofs and small sets: a reference that
/// gives the same edges at the same times as make_kinetic_edges().
///
/// R_i = 2^i R_0 and rho_i = 2 c R_i, where rho_0 is the largest distance of a pair. A node of level i is
/// within R_i of its parent (parent-child); two nodes of level i that an edge joins are within rho_i (edge),
/// and more than R_{i-1} apart (separation); two that none joins, with parents that are one or joined, are
/// farther apart than rho_i (potential edge). A certificate holds until the first outgoing root. Those that
/// fail at one time do so higher levels first, then by ids. An event costs O(nodes of a level) here, not O(lg
/// alpha): parents are looked for among all nodes.
class KineticHierarchy : public KineticEdges {
 public:
  virtual const KineticCounters& counters() const = 0;
  /// Locality: how many certificates a point has part in.
  virtual std::int64_t certificates_of(std::int32_t id) const = 0;
  virtual int levels() const = 0;
  /// Highest level in which a point stands.
  virtual int top_level(std::int32_t id) const = 0;
  /// The point's parent in the level above `level`: itself if it stands there; -1 for the root.
  virtual std::int32_t parent(std::int32_t id, int level) const = 0;
  /// Checks all invariants of Lemma 5.3.1, and that all certificates are there, against all pairs of each
  /// level now; pairs that are at a threshold to within 1e-9, or rounding, may stand on either side. Empty if
  /// all hold, else the first that does not.
  virtual std::string validate() const = 0;

 protected:
  using KineticEdges::KineticEdges;
};

/// @throws as make_kinetic_edges().
std::unique_ptr<KineticHierarchy> make_kinetic_hierarchy(const KineticParams& params,
                                                         Span<const FlightPlan> plans, double start);

}  // namespace dch::kinetic
#pragma GCC visibility pop

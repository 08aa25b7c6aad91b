// SPDX-License-Identifier: MIT
//
// The invariants of Lemma 5.3.1, each against all pairs of its level.
#include <cmath>
#include <string>

#include "certified_hierarchy.hpp"

namespace dch::kinetic {
namespace {

/// Pairs this near to a threshold may stand on either side of it, as a share.
constexpr double kBand = 1e-9;
constexpr double kRounding = 1e-14;

std::string text(int level, Edge edge, const char* what) {
  return "level " + std::to_string(level) + ", points " + std::to_string(edge.a) + " and " +
         std::to_string(edge.b) + ": " + what;
}

}  // namespace

std::string CertifiedHierarchy::validate() const {
  if (at(0).size() != size()) return "level 0 does not hold all points";
  if (size() > 0 && at(top()).size() != 1) return "the top level holds more than the root";
  for (int level = 0; level < levels(); ++level)
    if (std::string fault = check_level(level); !fault.empty()) return fault;
  if (ends_.size() != queue_.size() || static_cast<std::int64_t>(ends_.size()) != counters_.certificates)
    return "certificates are counted wrongly";
  return queue_.empty() || next_event() >= now_ ? "" : "a certificate has failed unseen";
}

std::string CertifiedHierarchy::check_level(int level) const {
  for (const auto& [id, node] : at(level))
    if (std::string fault = check_node(level, id); !fault.empty()) return fault;
  for (auto a = at(level).begin(); a != at(level).end(); ++a)
    for (auto b = std::next(a); b != at(level).end(); ++b)
      if (std::string fault = check_pair(level, {a->first, b->first}); !fault.empty()) return fault;
  return {};
}

/// Nesting, and a parent that covers.
std::string CertifiedHierarchy::check_node(int level, std::int32_t id) const {
  const std::int32_t parent = at(level).at(id).parent;
  const Edge edge{std::min(id, parent), std::max(id, parent)};
  if (level > 0 && !stands(level - 1, id)) return text(level, {id, id}, "does not stand in the level below");
  if (level == top()) return parent < 0 ? "" : text(level, edge, "the root has a parent");
  if (!stands(level + 1, parent)) return text(level, edge, "the parent does not stand in the level above");
  if (!at(level + 1).at(parent).children.contains(id)) return text(level, edge, "no child of its parent");
  if (stands(level + 1, id) != (parent == id)) return text(level, edge, "not its own parent");
  if (parent == id) return {};
  if (std::sqrt(distance2(id, parent)) > covering_radius(level) + rounding(edge, covering_radius(level)))
    return text(level, edge, "the parent does not cover its child");
  return has({level, edge, Kind::parent_child}) ? "" : text(level, edge, "no parent-child certificate");
}

/// By how much the distance of two points may be off, and so which invariants cannot be decided.
double CertifiedHierarchy::rounding(Edge edge, double distance) const {
  double sum = 0;
  for (const std::int32_t id : {edge.a, edge.b}) {
    const double speed = std::sqrt(norm2(velocity_at(plan(id), now_)) + norm2(plan(id).velocity));
    sum += std::sqrt(norm2(plan(id).position)) + speed * (std::abs(now_) + now_ - plan(id).time);
  }
  return kBand * distance + kRounding * sum;
}

/// Separation, edges just where they have to be, and with parents that are one or joined.
std::string CertifiedHierarchy::check_pair(int level, Edge edge) const {
  const double apart = std::sqrt(distance2(edge.a, edge.b)), limit = threshold(level, edge);
  const double off = rounding(edge, limit);
  const bool is_edge = are_joined(level, edge.a, edge.b), is_potential = are_potential(level, edge);
  if (level > 0 && apart < covering_radius(level - 1) - off) return text(level, edge, "not separated");
  // Those of level 0 that have just been found to be otherwise have their event ahead, at the present time.
  const bool is_due = level == 0 && next_event() <= now_;
  if (is_edge && apart > limit + off && !is_due) return text(level, edge, "joined, but too far apart");
  if (!is_edge && apart < limit - off && !is_due) return text(level, edge, "near, but not joined");
  if (is_edge && !is_potential) return text(level, edge, "joined, but their parents are not");
  if (has({level, edge, Kind::edge}) != is_edge) return text(level, edge, "edge certificate");
  if (level > 0 && has({level, edge, Kind::separation}) != is_edge)
    return text(level, edge, "separation certificate");
  if (has({level, edge, Kind::potential_edge}) != (is_potential && !is_edge))
    return text(level, edge, "potential edge certificate");
  return {};
}

}  // namespace dch::kinetic

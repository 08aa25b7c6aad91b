// SPDX-License-Identifier: MIT
#include "certified_hierarchy.hpp"

#include <algorithm>
#include <cmath>

#include "largest_distance.hpp"
#include "passage.hpp"

namespace dch::kinetic {
namespace {

/// c of rho_i = 2 c R_i: above 1.05, so that edges of parents come well before those of children.
constexpr double kStretch = 1.25;

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

CertifiedHierarchy::CertifiedHierarchy(const KineticParams& params, Span<const FlightPlan> plans,
                                       double start)
    : KineticHierarchy(params, plans, start),
      images_(params.box),
      base_radius_(largest_distance(params) / (2 * kStretch)),
      levels_(1) {
  for (std::int32_t id = 0; id < static_cast<std::int32_t>(size()); ++id) enter(0, id);
  is_building_ = false;
  counters_.made = 0;
  counters_.most_certificates = counters_.certificates;
}

double CertifiedHierarchy::next_event() const {
  if (queue_.empty()) return kNever;
  return queue_.begin()->time;
}

std::vector<Edge> CertifiedHierarchy::edges() const {
  std::vector<Edge> edges;
  for (const auto& [id, node] : at(0))
    for (const std::int32_t other : node.neighbors)
      if (id < other) edges.push_back({id, other});
  return edges;
}

std::int64_t CertifiedHierarchy::certificates_of(std::int32_t id) const {
  std::set<Key> all;
  for (int level = 0; stands(level, id); ++level) {
    const Node& node = at(level).at(id);
    all.insert(node.certificates.begin(), node.certificates.end());
  }
  return static_cast<std::int64_t>(all.size());
}

int CertifiedHierarchy::top_level(std::int32_t id) const {
  int level = 0;
  while (stands(level + 1, id)) ++level;
  return level;
}

std::int32_t CertifiedHierarchy::parent(std::int32_t id, int level) const { return at(level).at(id).parent; }

std::optional<EdgeEvent> CertifiedHierarchy::next_until(double limit) {
  while (next_event() <= limit) {
    const End end = *queue_.begin();
    now_ = end.time;
    begin_change();
    if (end.is_renewal) {
      ++counters_.renewals;
      make(end.key);
      continue;
    }
    fail(end.key);
    end_change();
    if (end.key.level > 0 || !(end.key.kind == Kind::edge || end.key.kind == Kind::potential_edge)) continue;
    ++counters_.external;
    return EdgeEvent{now_, end.key.edge, end.key.kind == Kind::potential_edge};
  }
  now_ = limit;
  return std::nullopt;
}

void CertifiedHierarchy::follow(std::int32_t id) {
  begin_change();
  for (int level = 0; stands(level, id); ++level) {
    const std::set<Key> keys = node(level, id).certificates;
    for (const Key& key : keys) make(key);
  }
  end_change();
}

void CertifiedHierarchy::end_change() {
  counters_.most_made_by_one = std::max(counters_.most_made_by_one, counters_.made - made_before_);
  counters_.most_certificates = std::max(counters_.most_certificates, counters_.certificates);
}

/// The four events of thesis 5.5.1.
void CertifiedHierarchy::fail(const Key& key) {
  const auto [a, b] = key.edge;
  switch (key.kind) {
    case Kind::parent_child: {
      ++counters_.lost_parents;
      const std::int32_t child = stands(key.level, a) && node(key.level, a).parent == b ? a : b;
      clear_parent(key.level, child);
      find_parent(key.level, child);
      shrink();
      break;
    }
    case Kind::separation:
      ++counters_.demotions;
      separate(key);
      shrink();
      break;
    case Kind::edge:
      counters_.upper_edges += key.level > 0;
      remove_edge(key.level, key.edge);
      break;
    case Kind::potential_edge:
      counters_.upper_edges += key.level > 0;
      add_edge(key.level, key.edge);
      break;
  }
}

/// One of the two leaves the level: one that does not stand above it, since a higher certificate would have
/// failed before if both did.
void CertifiedHierarchy::separate(const Key& key) {
  leave(key.level, stands(key.level + 1, key.edge.b) ? key.edge.a : key.edge.b);
}

double CertifiedHierarchy::covering_radius(int level) const { return std::ldexp(base_radius_, level); }

/// rho_i; of level 0 the distance of the pair itself.
double CertifiedHierarchy::threshold(int level, Edge edge) const {
  return level == 0 ? distance(edge) : 2 * kStretch * covering_radius(level);
}

double CertifiedHierarchy::threshold_of(const Key& key) const {
  if (key.kind == Kind::parent_child) return covering_radius(key.level);
  return key.kind == Kind::separation ? covering_radius(key.level - 1) : threshold(key.level, key.edge);
}

bool CertifiedHierarchy::is_within(Edge edge, double distance) const {
  return is_any_within(images_, plan(edge.a), plan(edge.b), distance, now_);
}

double CertifiedHierarchy::distance2(std::int32_t a, std::int32_t b) const {
  return box().distance2(position(a), position(b));
}

/// Asks for the certificates that a pair of a level needs: none if it is neither an edge nor can be one.
/// @param has_changed whether it has just become an edge, or ceased to be one
void CertifiedHierarchy::renew_pair(int level, std::int32_t a, std::int32_t b, bool has_changed) {
  if (a == b) return;
  const Edge edge = edge_of(a, b);
  const bool is_edge = are_joined(level, a, b), is_potential = !is_edge && are_potential(level, edge);
  want({level, edge, Kind::edge}, is_edge, has_changed);
  if (level > 0) want({level, edge, Kind::separation}, is_edge);
  const Key potential{level, edge, Kind::potential_edge};
  // New nodes get their edges at once. Those of level 0 are told of after the start, so they are events.
  const bool may_be_at_once = is_potential && !has_changed && (level > 0 || is_building_) && !has(potential);
  if (may_be_at_once && is_within(edge, threshold(level, edge))) return add_edge(level, edge);
  want(potential, is_potential, has_changed);
}

/// The pairs of children of two nodes, which may be edges while these are joined.
void CertifiedHierarchy::renew_children(int level, Edge edge) {
  if (level == 0) return;
  for (const std::int32_t x : std::set<std::int32_t>(node(level, edge.a).children))
    for (const std::int32_t y : std::set<std::int32_t>(node(level, edge.b).children))
      renew_pair(level - 1, x, y);
}

void CertifiedHierarchy::want(const Key& key, bool is_wanted, bool has_crossed) {
  if (is_wanted == has(key)) return;
  if (is_wanted) {
    make(key, has_crossed);
  } else {
    drop(key);
  }
}

/// Anew if it is there already. One that does not hold fails at once.
/// @param has_crossed whether the pair has just crossed its distance, so that rounding is not asked
void CertifiedHierarchy::make(const Key& key, bool has_crossed) {
  drop(key);
  ++counters_.made;
  ++counters_.certificates;
  const bool within = holds_within(key.kind);
  const double distance = threshold_of(key);
  End end{now_, key, false};
  if (has_crossed || is_within(key.edge, distance) == within) {
    const Passage passage = next_passage(images_, plan(key.edge.a), plan(key.edge.b), distance, now_, within);
    end = {passage.time, key, passage.is_renewal};
  }
  ends_.emplace(key, end);
  queue_.insert(end);
  for (const std::int32_t id : {key.edge.a, key.edge.b})
    if (stands(key.level, id)) node(key.level, id).certificates.insert(key);
}

void CertifiedHierarchy::drop(const Key& key) {
  const auto found = ends_.find(key);
  if (found == ends_.end()) return;
  queue_.erase(found->second);
  ends_.erase(found);
  --counters_.certificates;
  for (const std::int32_t id : {key.edge.a, key.edge.b})
    if (stands(key.level, id)) node(key.level, id).certificates.erase(key);
}

std::unique_ptr<KineticHierarchy> make_kinetic_hierarchy(const KineticParams& params,
                                                         Span<const FlightPlan> plans, double start) {
  return std::make_unique<CertifiedHierarchy>(params, plans, start);
}

}  // namespace dch::kinetic

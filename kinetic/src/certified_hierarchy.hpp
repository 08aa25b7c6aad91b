// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <dch/kinetic/kinetic_hierarchy.hpp>

#include "images.hpp"

namespace dch::kinetic {

/// The reference. Every change of the structure goes through a few steps that keep the certificates as they
/// have to be: enter, leave, set_parent, add_edge, remove_edge.
class CertifiedHierarchy : public KineticHierarchy {
 public:
  CertifiedHierarchy(const KineticParams& params, Span<const FlightPlan> plans, double start);

  double next_event() const override;
  std::vector<Edge> edges() const override;
  const KineticCounters& counters() const override { return counters_; }
  std::int64_t certificates_of(std::int32_t id) const override;
  int levels() const override { return static_cast<int>(levels_.size()); }
  int top_level(std::int32_t id) const override;
  std::int32_t parent(std::int32_t id, int level) const override;
  std::string validate() const override;

 protected:
  std::optional<EdgeEvent> next_until(double limit) override;
  void follow(std::int32_t id) override;

 private:
  enum class Kind : std::int8_t { parent_child, separation, edge, potential_edge };
  /// Names a certificate; that of a node and its parent goes by the level of the node.
  struct Key {
    int level;
    Edge edge;
    Kind kind;
    auto order() const { return std::make_tuple(-level, edge.a, edge.b, kind); }
    bool operator<(const Key& other) const { return order() < other.order(); }
  };
  /// The end of a certificate.
  struct End {
    double time;
    Key key;
    bool is_renewal;
    bool operator<(const End& other) const {
      return time != other.time ? time < other.time : key < other.key;
    }
  };
  struct Node {
    std::int32_t parent = -1;
    std::set<std::int32_t> children{};   ///< in the level below
    std::set<std::int32_t> neighbors{};  ///< joined by an edge
    std::set<Key> certificates{};        ///< of this level that the node has part in
  };
  using Level = std::map<std::int32_t, Node>;

  Level& at(int level) { return levels_[static_cast<std::size_t>(level)]; }
  const Level& at(int level) const { return levels_[static_cast<std::size_t>(level)]; }
  Node& node(int level, std::int32_t id) { return at(level).at(id); }
  bool stands(int level, std::int32_t id) const { return level < levels() && at(level).contains(id); }
  int top() const { return levels() - 1; }

  double covering_radius(int level) const;
  double threshold(int level, Edge edge) const;
  double threshold_of(const Key& key) const;
  bool is_within(Edge edge, double distance) const;
  double distance2(std::int32_t a, std::int32_t b) const;

  // The structure
  void enter(int level, std::int32_t id);
  void leave(int level, std::int32_t id);
  void find_parent(int level, std::int32_t id);
  std::int32_t nearest_cover(int level, std::int32_t id) const;
  void grow();
  void shrink();
  void set_parent(int level, std::int32_t id, std::int32_t parent);
  void clear_parent(int level, std::int32_t id);
  void add_edge(int level, Edge edge);
  void remove_edge(int level, Edge edge);
  bool are_joined(int level, std::int32_t a, std::int32_t b) const;
  bool are_potential(int level, Edge edge) const;

  // Its certificates
  void renew_pair(int level, std::int32_t a, std::int32_t b, bool has_changed = false);
  void renew_children(int level, Edge edge);
  static bool holds_within(Kind kind) { return kind == Kind::parent_child || kind == Kind::edge; }
  bool has(const Key& key) const { return ends_.contains(key); }
  void want(const Key& key, bool is_wanted, bool has_crossed = false);
  void make(const Key& key, bool has_crossed = false);
  void drop(const Key& key);

  // Their failure
  void fail(const Key& key);
  void separate(const Key& key);
  void begin_change() { made_before_ = counters_.made; }
  void end_change();

  double rounding(Edge edge, double distance) const;
  std::string check_level(int level) const;
  std::string check_node(int level, std::int32_t id) const;
  std::string check_pair(int level, Edge edge) const;

  Images images_;
  double base_radius_;  ///< R_0 [length]
  std::vector<Level> levels_;
  std::map<Key, End> ends_;
  std::set<End> queue_;
  KineticCounters counters_;
  std::int64_t made_before_ = 0;
  bool is_building_ = true;
};

}  // namespace dch::kinetic

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/necklace/contacts.hpp>
#include <dch/pair_search.hpp>

#include "contact_check.hpp"
#include "contact_descent.hpp"
#include "contact_of.hpp"
#include "found_pairs.hpp"

namespace dch::necklace {

namespace {

/// From how many chains on a cell list of roots is worth its cost.
constexpr std::size_t kManyChains = 32;

void check(const CageHierarchy& hierarchy, const ContactQuery& query) {
  detail::check_query(hierarchy.necklace(), hierarchy.box(), query);
  if (hierarchy.beads().size() != hierarchy.necklace().size()) {
    throw InvalidParameter("the hierarchy has no positions; update it before it is searched");
  }
}

/// Stops at the first contact.
struct Any {
  static constexpr bool kWantsSeparated = false;
  bool found = false;
  bool done() const { return found; }
  void contact(std::int32_t, std::int32_t) { found = true; }
  void separated(const CagedBeads&, const CagedBeads&) {}
};

/// Collects contacts.
struct All {
  explicit All(const CageHierarchy& hierarchy) : contacts(hierarchy.necklace().particle()) {}
  static constexpr bool kWantsSeparated = false;
  detail::FoundPairs contacts;
  static bool done() { return false; }
  void contact(std::int32_t p, std::int32_t q) { contacts.add(p, q); }
  void separated(const CagedBeads&, const CagedBeads&) {}
};

/// Collects separating pairs too.
struct Certified : All {
  using All::All;
  static constexpr bool kWantsSeparated = true;
  std::vector<SeparatingPair> pairs;
  void separated(const CagedBeads& a, const CagedBeads& b) { pairs.push_back({a, b}); }
};

/// Pairs of chains whose roots may be close to each other; all of them if `all`.
std::vector<IndexPair> pairs_of_chains(const CageHierarchy& hierarchy, double gap, bool all) {
  const auto roots = hierarchy.trees().roots();
  std::vector<Vec3> centers;
  std::vector<double> radii;
  ListParams params;
  params.skin = std::max(gap, 0.0) + hierarchy.rounding();
  double largest = 0;
  for (const std::int32_t root : roots) {
    const Ball& cage = hierarchy.cages()[static_cast<std::size_t>(root)];
    centers.push_back(cage.center);
    radii.push_back(cage.radius * (1 + 1e-11));
    largest = std::max(largest, radii.back());
  }
  params.radii = radii;
  std::vector<IndexPair> result;
  const bool by_cells = !all && roots.size() >= kManyChains && largest > 0 &&
                        2 * largest + params.skin <= hierarchy.box().max_cutoff();
  if (!by_cells) {
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(roots.size()); ++a) {
      for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(roots.size()); ++b) result.push_back({a, b});
    }
    return result;
  }
  const auto search = make_cell_search(params.list_radius());
  search->update(centers, hierarchy.box());
  const NeighborList list = search->list(params);
  for (std::size_t a = 0; a < list.size(); ++a) {
    for (const std::int32_t b : list.row(a)) result.push_back({static_cast<std::int32_t>(a), b});
  }
  return result;
}

template <class Visitor>
void search(const CageHierarchy& hierarchy, const ContactQuery& query, Visitor& visitor,
            ContactStats* stats) {
  check(hierarchy, query);
  detail::ContactDescent<Visitor> descent(hierarchy, query, visitor);
  const std::size_t chains = hierarchy.necklace().chains().size();
  for (std::size_t chain = 0; query.within_chains && chain < chains && !visitor.done(); ++chain) {
    descent.within(chain);
  }
  if (query.between_chains && chains > 1 && !visitor.done()) {
    for (const auto& [a, b] : pairs_of_chains(hierarchy, query.gap, Visitor::kWantsSeparated)) {
      if (visitor.done()) break;
      descent.between(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
  }
  if (stats != nullptr) *stats = descent.stats();
}

Contact contact_at(const CageHierarchy& hierarchy, const detail::FoundPairs::Pair& pair) {
  const auto first = static_cast<std::size_t>(pair.places[0]);
  const auto second = static_cast<std::size_t>(pair.places[1]);
  const Vec3 at = hierarchy.positions()[first];
  const Vec3 d = hierarchy.box().nearest_image(hierarchy.positions()[second] - at);
  return detail::contact_of(pair.i(), pair.j(), at, d, hierarchy.beads()[first].radius,
                            hierarchy.beads()[second].radius);
}

std::vector<Contact> sorted(const CageHierarchy& hierarchy, All& found) {
  const auto& pairs = found.contacts.sorted();
  std::vector<Contact> result;
  result.reserve(pairs.size());
  for (const auto& pair : pairs) result.push_back(contact_at(hierarchy, pair));
  return result;
}

}  // namespace

void detail::check_query(const Necklace& necklace, const Box& box, const ContactQuery& query) {
  if (!std::isfinite(query.gap)) {
    throw InvalidParameter("the gap is " + std::to_string(query.gap) + "; it has to be finite");
  }
  if (query.skip_bonds < 0) {
    throw InvalidParameter("skip_bonds is " + std::to_string(query.skip_bonds) + "; it has to be 0 or more");
  }
  const double reach = 2 * necklace.largest_radius() + query.gap;
  if (reach > box.max_cutoff()) {
    throw CutoffTooLarge("twice the largest radius + gap is " + std::to_string(reach) +
                         ", which exceeds half the smallest box height, " + std::to_string(box.max_cutoff()) +
                         "; take a smaller gap or a larger box");
  }
}

bool any_contact(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats) {
  Any visitor;
  search(hierarchy, query, visitor, stats);
  return visitor.found;
}

std::vector<Contact> find_contacts(const CageHierarchy& hierarchy, const ContactQuery& query,
                                   ContactStats* stats) {
  All visitor(hierarchy);
  search(hierarchy, query, visitor, stats);
  return sorted(hierarchy, visitor);
}

Separation separate(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats) {
  Certified visitor(hierarchy);
  search(hierarchy, query, visitor, stats);
  return {std::move(visitor.pairs), sorted(hierarchy, visitor)};
}

}  // namespace dch::necklace

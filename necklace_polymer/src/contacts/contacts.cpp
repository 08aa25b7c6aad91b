// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include <dch/base/executor.hpp>
#include <dch/necklace/contacts.hpp>

#include "contacts/contact_check.hpp"
#include "contacts/contact_descent.hpp"
#include "contacts/contact_of.hpp"
#include "contacts/contact_tasks.hpp"

namespace dch::necklace {

namespace {

void check(const CageHierarchy& hierarchy, const ContactQuery& query) {
  detail::check_query(hierarchy.necklace(), hierarchy.box(), query);
  if (hierarchy.beads().size() != hierarchy.necklace().size()) {
    throw InvalidParameter("the hierarchy has no positions; update it before it is searched");
  }
}

/// Stops at the first contact, on whichever thread it is found.
struct Any {
  static constexpr bool kWantsSeparated = false;
  std::atomic<bool>& found;
  Any part() const { return *this; }
  void join(Any&&) {}
  bool done() const { return found.load(std::memory_order_relaxed); }
  void contact(std::int32_t, std::int32_t) { found.store(true, std::memory_order_relaxed); }
  void separated(const CagedBeads&, const CagedBeads&) {}
};

/// Collects contacts.
struct All {
  explicit All(const CageHierarchy& of) : hierarchy(of), contacts(of.necklace().particle()) {}
  static constexpr bool kWantsSeparated = false;
  const CageHierarchy& hierarchy;
  detail::FoundPairs contacts;
  All part() const { return All(hierarchy); }
  void join(All&& part) { contacts.add(std::move(part.contacts)); }
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

/// A search on several threads is cut into so many parts for each, so that the last ones do not keep the
/// others waiting.
constexpr int kPartsOfThread = 8;
/// Nodes of fewer beads are not worth a task.
constexpr std::int64_t kMinTaskBeads = 64;

template <class Visitor>
ContactStats search_alone(const CageHierarchy& hierarchy, const ContactQuery& query, Visitor& visitor) {
  detail::ContactDescent<Visitor> descent(hierarchy, query, visitor);
  const detail::ChainTasks tasks(hierarchy, query, Visitor::kWantsSeparated);
  for (std::size_t chain = 0; chain < tasks.chains() && !visitor.done(); ++chain) {
    tasks.of_chain(chain, [&](const detail::ContactTask& task) { descent.run(task); });
  }
  return descent.stats();
}

/// The parts of a search on several threads.
struct SearchParts {
  detail::ChainTasks chains;
  std::int64_t max_beads;                    ///< beads of a task that is left whole
  std::vector<detail::ContactTask> smaller;  ///< what those of more beads were begun into
};

template <class Visitor>
SearchParts parts_of(const CageHierarchy& hierarchy, const ContactQuery& query, int threads,
                     detail::ContactDescent<Visitor>& descent) {
  const ChainTrees& trees = hierarchy.trees();
  SearchParts parts{{hierarchy, query, false}, 0, {}};
  const auto beads = static_cast<std::int64_t>(hierarchy.necklace().size());
  parts.max_beads = std::max(beads / (kPartsOfThread * threads), kMinTaskBeads);
  std::vector<detail::ContactTask> large;
  std::int64_t longest = 0;
  for (const std::int32_t root : trees.roots())
    longest = std::max<std::int64_t>(longest, trees.node(root).count);
  for (std::size_t chain = 0; 2 * longest > parts.max_beads && chain < parts.chains.chains(); ++chain) {
    parts.chains.of_chain(chain, [&](const detail::ContactTask& task) {
      if (beads_of(trees, task) > parts.max_beads) large.push_back(task);
    });
  }
  while (!large.empty()) {
    const detail::ContactTask task = large.back();
    large.pop_back();
    if (beads_of(trees, task) > parts.max_beads) {
      descent.begin(task, large);
    } else {
      parts.smaller.push_back(task);
    }
  }
  return parts;
}

template <class Visitor>
ContactStats search_side_by_side(const CageHierarchy& hierarchy, const ContactQuery& query, Visitor& visitor,
                                 Executor& executor) {
  const ChainTrees& trees = hierarchy.trees();
  detail::ContactDescent<Visitor> first(hierarchy, query, visitor);
  const SearchParts parts = parts_of(hierarchy, query, executor.threads(), first);
  const int count = kPartsOfThread * executor.threads();
  const auto begins = detail::equal_ranges(trees, parts.smaller, static_cast<std::size_t>(count));
  const int ranges = static_cast<int>(begins.size()) - 1;
  const auto run_range = [&](std::size_t range, detail::ContactDescent<Visitor>& descent) {
    for (std::size_t k = begins[range]; k < begins[range + 1]; ++k) descent.run(parts.smaller[k]);
  };
  // Chains of lower index have more pairs.
  const auto run_every = [&](std::size_t chain, detail::ContactDescent<Visitor>& descent) {
    for (; chain < parts.chains.chains(); chain += static_cast<std::size_t>(count)) {
      parts.chains.of_chain(chain, [&](const detail::ContactTask& task) {
        if (beads_of(trees, task) <= parts.max_beads) descent.run(task);
      });
    }
  };
  ContactStats sum = first.stats();
  std::mutex joining;
  executor.run(ranges + count, [&](int part) {
    Visitor found = visitor.part();
    detail::ContactDescent<Visitor> descent(hierarchy, query, found);
    if (part < ranges) {
      run_range(static_cast<std::size_t>(part), descent);
    } else {
      run_every(static_cast<std::size_t>(part - ranges), descent);
    }
    const std::lock_guard lock(joining);
    visitor.join(std::move(found));
    sum.cage_pairs += descent.stats().cage_pairs;
    sum.bead_pairs += descent.stats().bead_pairs;
  });
  return sum;
}

template <class Visitor>
void search(const CageHierarchy& hierarchy, const ContactQuery& query, Visitor& visitor, ContactStats* stats,
            Executor* executor) {
  check(hierarchy, query);
  const bool alone = executor == nullptr || executor->threads() == 1;
  const ContactStats sum = alone ? search_alone(hierarchy, query, visitor)
                                 : search_side_by_side(hierarchy, query, visitor, *executor);
  if (stats != nullptr) *stats = sum;
}

Contact contact_at(const CageHierarchy& hierarchy, const detail::FoundPairs::Pair& pair) {
  const auto first = static_cast<std::size_t>(pair.places[0]);
  const auto second = static_cast<std::size_t>(pair.places[1]);
  const Vec3 at = hierarchy.positions()[first];
  const Vec3 d = hierarchy.box().nearest_image(hierarchy.positions()[second] - at);
  return detail::contact_of(pair.i(), pair.j(), at, d, hierarchy.beads()[first].radius,
                            hierarchy.beads()[second].radius);
}

std::vector<Contact> sorted(All& found, Executor* executor) {
  return detail::contacts_of(found.contacts, executor, [&](const detail::FoundPairs::Pair& pair) {
    return contact_at(found.hierarchy, pair);
  });
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

bool any_contact(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats,
                 Executor* executor) {
  std::atomic<bool> found{false};
  Any visitor{found};
  search(hierarchy, query, visitor, stats, executor);
  return found;
}

std::vector<Contact> find_contacts(const CageHierarchy& hierarchy, const ContactQuery& query,
                                   ContactStats* stats, Executor* executor) {
  All visitor(hierarchy);
  search(hierarchy, query, visitor, stats, executor);
  return sorted(visitor, executor);
}

Separation separate(const CageHierarchy& hierarchy, const ContactQuery& query, ContactStats* stats) {
  check(hierarchy, query);
  Certified visitor(hierarchy);
  const ContactStats sum = search_alone(hierarchy, query, visitor);
  if (stats != nullptr) *stats = sum;
  return {std::move(visitor.pairs), sorted(visitor, nullptr)};
}

}  // namespace dch::necklace

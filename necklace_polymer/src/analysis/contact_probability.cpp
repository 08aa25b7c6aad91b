// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <dch/necklace/contact_probability.hpp>

#include "analysis/bead_places.hpp"
#include "chains/parameter_check.hpp"

namespace dch::necklace {

namespace {

/// Largest number of bonds between two beads of a chain.
std::size_t longest_separation(std::size_t beads, bool closed) { return closed ? beads / 2 : beads - 1; }

/// Pairs of beads with s bonds between them, 1 <= s <= longest_separation().
std::int64_t pairs_at(std::size_t s, std::size_t beads, bool closed) {
  if (!closed) return static_cast<std::int64_t>(beads - s);
  return static_cast<std::int64_t>(2 * s == beads ? s : beads);
}

double ratio(std::int64_t contacts, std::int64_t pairs, std::int64_t frames) {
  if (pairs == 0 || frames == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(contacts) / (static_cast<double>(pairs) * static_cast<double>(frames));
}

}  // namespace

ContactProbability::ContactProbability(const Necklace& necklace, const ContactQuery& query)
    : necklace_(necklace), place_(detail::places_by_particle(necklace)) {
  detail::require_parameter(query.skip_bonds >= 0,
                            "skip_bonds is " + std::to_string(query.skip_bonds) + "; it has to be 0 or more");
  const Chains& chains = necklace.chains();
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    const std::size_t beads = chains.beads(chain).size();
    const std::size_t longest = longest_separation(beads, chains.closed(chain));
    if (pairs_.size() <= longest) pairs_.resize(longest + 1);
    if (!query.within_chains) continue;
    for (auto s = static_cast<std::size_t>(query.skip_bonds) + 1; s <= longest; ++s) {
      pairs_[s] += pairs_at(s, beads, chains.closed(chain));
    }
  }
  contacts_.resize(pairs_.size());
}

void ContactProbability::add(Span<const Contact> contacts) {
  for (const Contact& contact : contacts) {
    const auto [p, q] = detail::places_of(contact, place_);
    const std::int32_t separation = necklace_.bonds_between(p, q);
    if (separation >= 0) ++contacts_[static_cast<std::size_t>(separation)];
  }
  ++frames_;
}

double ContactProbability::probability(std::size_t separation) const {
  return ratio(contacts_[separation], pairs_[separation], frames_);
}

std::vector<SeparationRange> ContactProbability::ranges(int per_decade) const {
  detail::require_parameter(
      per_decade >= 1 && per_decade <= 1000,
      "the number of ranges a decade is " + std::to_string(per_decade) + "; it has to be 1 to 1000");
  const double factor = std::pow(10, 1.0 / per_decade);
  std::vector<SeparationRange> result;
  for (std::size_t s = 1; s < pairs_.size(); ++s) {
    if (pairs_[s] == 0) continue;
    const auto separation = static_cast<std::int32_t>(s);
    if (result.empty() || separation >= factor * result.back().first) {
      result.push_back({separation, separation, 0, 0, 0});
    }
    result.back().last = separation;
    result.back().contacts += contacts_[s];
    result.back().pairs += pairs_[s];
  }
  for (SeparationRange& range : result) range.probability = ratio(range.contacts, range.pairs, frames_);
  return result;
}

}  // namespace dch::necklace

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <dch/necklace/contacts.hpp>

namespace dch::necklace {

namespace {

std::string named(std::size_t pair) { return "separating pair " + std::to_string(pair); }

std::string place_pair(std::size_t p, std::size_t q) {
  return "the beads at places " + std::to_string(p) + " and " + std::to_string(q);
}

/// Ticks pairs of places off.
class Coverage {
 public:
  explicit Coverage(std::size_t places) : places_(places), ticked_(places * places, false) {}

  /// False if the pair has been ticked off before.
  bool tick(std::size_t p, std::size_t q) {
    if (p > q) std::swap(p, q);
    if (ticked_[p * places_ + q]) return false;
    return ticked_[p * places_ + q] = true;
  }
  bool ticked(std::size_t p, std::size_t q) const { return ticked_[p * places_ + q]; }

 private:
  std::size_t places_;
  std::vector<bool> ticked_;
};

bool encloses_its_beads(const CageHierarchy& hierarchy, const CagedBeads& caged) {
  const auto beads = hierarchy.beads();
  for (std::int32_t k = caged.first; k < caged.first + caged.count; ++k) {
    const Ball& bead = beads[static_cast<std::size_t>(k)];
    const double reach = std::sqrt(norm2(bead.center - caged.cage.center)) + bead.radius;
    if (reach > caged.cage.radius * (1 + 1e-11)) return false;
  }
  return true;
}

/// For a pair of single beads the pair distance decides, as it does for contacts.
bool apart(const CageHierarchy& hierarchy, const SeparatingPair& pair, double gap) {
  const bool single = pair.a.count == 1 && pair.b.count == 1;
  const auto p = static_cast<std::size_t>(pair.a.first), q = static_cast<std::size_t>(pair.b.first);
  const double reach = pair.a.cage.radius + pair.b.cage.radius + gap;
  const double distance2 = single
                               ? hierarchy.box().distance2(hierarchy.positions()[p], hierarchy.positions()[q])
                               : hierarchy.box().distance2(pair.a.cage.center, pair.b.cage.center);
  return reach < 0 || distance2 > reach * reach;
}

std::string check_pair(const CageHierarchy& hierarchy, double gap, const SeparatingPair& pair,
                       Coverage& coverage) {
  const auto size = static_cast<std::int64_t>(hierarchy.necklace().size());
  for (const CagedBeads* caged : {&pair.a, &pair.b}) {
    if (caged->first < 0 || caged->count < 1 || std::int64_t{caged->first} + caged->count > size) {
      return " has beads that do not exist";
    }
    if (!encloses_its_beads(hierarchy, *caged)) return " has a cage that lets out a bead";
  }
  if (!apart(hierarchy, pair, gap)) return " is not apart";
  for (std::int32_t p = pair.a.first; p < pair.a.first + pair.a.count; ++p) {
    for (std::int32_t q = pair.b.first; q < pair.b.first + pair.b.count; ++q) {
      if (!coverage.tick(static_cast<std::size_t>(p), static_cast<std::size_t>(q))) {
        return " covers " + place_pair(static_cast<std::size_t>(p), static_cast<std::size_t>(q)) + " again";
      }
    }
  }
  return {};
}

bool asked_for(const Necklace& necklace, const ContactQuery& query, std::size_t p, std::size_t q) {
  const std::int32_t bonds =
      necklace.bonds_between(static_cast<std::int32_t>(p), static_cast<std::int32_t>(q));
  return bonds < 0 ? query.between_chains : query.within_chains && bonds > query.skip_bonds;
}

}  // namespace

std::string check_certificate(const CageHierarchy& hierarchy, const ContactQuery& query,
                              const Separation& separation) {
  const Necklace& necklace = hierarchy.necklace();
  Coverage coverage(necklace.size());
  for (std::size_t k = 0; k < separation.pairs.size(); ++k) {
    const std::string wrong = check_pair(hierarchy, query.gap, separation.pairs[k], coverage);
    if (!wrong.empty()) return named(k) + wrong;
  }
  std::vector<std::size_t> place_of(necklace.particles(), necklace.size());
  for (std::size_t p = 0; p < necklace.size(); ++p) {
    place_of[static_cast<std::size_t>(necklace.particle()[p])] = p;
  }
  for (const Contact& contact : separation.contacts) {
    const std::size_t p = place_of[static_cast<std::size_t>(contact.i)];
    const std::size_t q = place_of[static_cast<std::size_t>(contact.j)];
    if (!coverage.tick(p, q)) return place_pair(p, q) + " are in contact and separated, or in contact twice";
  }
  for (std::size_t p = 0; p < necklace.size(); ++p) {
    for (std::size_t q = p + 1; q < necklace.size(); ++q) {
      const bool asked = asked_for(necklace, query, p, q);
      // A cage may hold beads that the query leaves out.
      if (asked && !coverage.ticked(p, q)) return place_pair(p, q) + " are covered by nothing";
    }
  }
  return {};
}

}  // namespace dch::necklace

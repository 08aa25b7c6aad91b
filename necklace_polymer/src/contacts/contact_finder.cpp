// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include <dch/engines/pair_search.hpp>
#include <dch/necklace/contact_finder.hpp>

#include "chains/bead_check.hpp"
#include "contacts/beside_place.hpp"
#include "contacts/contact_check.hpp"
#include "contacts/contact_of.hpp"

namespace dch::necklace {

namespace {

void check(const ContactFinderParams& params) {
  if (!(params.to_dch >= 0) || !(params.to_wrapped >= 0 && params.to_wrapped <= params.to_dch)) {
    throw InvalidParameter("to_wrapped is " + std::to_string(params.to_wrapped) + " and to_dch " +
                           std::to_string(params.to_dch) + "; it has to be 0 <= to_wrapped <= to_dch");
  }
  if (params.measure_every < 1) {
    throw InvalidParameter("measure_every is " + std::to_string(params.measure_every) +
                           "; it has to be 1 or more");
  }
}

std::string with_two_digits(double value) {
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + 3);
}

}  // namespace

std::string name_of(Structure structure) { return structure == Structure::wrapped ? "wrapped" : "dch"; }

ContactFinder::ContactFinder(Necklace necklace, const ContactFinderParams& params)
    : params_(params), wrapped_(std::move(necklace), params.wrapped) {
  check(params);
  const Necklace& chains = wrapped_.necklace();
  for (const std::int32_t particle : chains.particle()) radii_.push_back(chains.radius(particle));
  if (!radii_.empty()) smallest_radius_ = *std::min_element(radii_.begin(), radii_.end());
}

void ContactFinder::update(Span<const Vec3> positions, const Box& box) {
  ready_ = false;
  detail::check_positions(necklace(), positions);
  given_.assign(positions.begin(), positions.end());
  by_place_.clear();
  box_ = box;
  wrapped_is_new_ = search_is_new_ = false;
  ready_ = true;
}

void ContactFinder::replace(Necklace necklace, Span<const std::uint64_t> names) {
  if (!names.empty() && names.size() != necklace.particles()) {
    throw InvalidParameter("there are " + std::to_string(names.size()) + " names for " +
                           std::to_string(necklace.particles()) + " particles; give one for each, or none");
  }
  ContactFinder other(std::move(necklace), params_);
  if (!names.empty()) {
    for (const std::int32_t particle : other.necklace().particle())
      other.names_.push_back(names[static_cast<std::size_t>(particle)]);
  }
  other.choice_ = choice_;  // the last that may throw
  if (!names_.empty() && !other.names_.empty()) {
    other.search_ = std::move(search_);
    other.search_radius_ = search_radius_;
    other.search_is_sized_ = search_is_sized_;
    std::swap(other.list_, list_);
  }
  other.since_measured_ = since_measured_;
  other.answered_by_ = answered_by_;
  *this = std::move(other);
}

bool ContactFinder::any_contact(const ContactQuery& query) {
  std::vector<Contact> found;
  if (const auto request = request_of_turn(query)) return by_dch(*request, query, true, found);
  ContactStats stats;
  const bool any = necklace::any_contact(wrapped_, query, &stats, params_.executor);
  answered_by_ = Structure::wrapped;
  if (!any) measured(stats);
  return any;
}

std::vector<Contact> ContactFinder::find_contacts(const ContactQuery& query) {
  std::vector<Contact> found;
  if (const auto request = request_of_turn(query)) {
    by_dch(*request, query, false, found);
    return found;
  }
  ContactStats stats;
  found = necklace::find_contacts(wrapped_, query, &stats, params_.executor);
  answered_by_ = Structure::wrapped;
  measured(stats);
  return found;
}

std::size_t ContactFinder::memory_bytes() const {
  return wrapped_.memory_bytes() + (search_ != nullptr ? search_->stats().memory_bytes : 0) +
         list_.first.capacity() * sizeof(list_.first[0]) + list_.j.capacity() * sizeof(list_.j[0]) +
         list_.particle.capacity() * sizeof(list_.particle[0]) + radii_.capacity() * sizeof(double) +
         names_.capacity() * sizeof(names_[0]) + (given_.capacity() + by_place_.capacity()) * sizeof(Vec3);
}

bool ContactFinder::is_turn_of_wrapped() const {
  return choice_.structure == Structure::wrapped || since_measured_ + 1 >= params_.measure_every;
}

const WrappedHierarchy& ContactFinder::wrapped_now() {
  if (!wrapped_is_new_) wrapped_.update(given_, box_);
  wrapped_is_new_ = true;
  return wrapped_;
}

/// Whether the wrapped hierarchy can be asked; if not, there is nothing to measure now.
bool ContactFinder::wrapped_takes() {
  try {
    wrapped_now();
    return true;
  } catch (const Undetermined&) {
    if (params_.refuse_undetermined) throw;
    since_measured_ = 0;
    return false;
  }
}

/// Brings the structure up to date that answers the next search: the DCH if there is a request for a list,
/// else the wrapped hierarchy.
std::optional<ListParams> ContactFinder::request_of_turn(const ContactQuery& query) {
  if (!ready_) throw InvalidParameter("there are no positions; update before a search");
  detail::check_query(necklace(), box_, query);
  if (is_turn_of_wrapped() && wrapped_takes()) return std::nullopt;
  if (by_place_.empty()) place_beads();
  if (params_.refuse_undetermined && box_.any_periodic()) require_determined();
  std::optional<ListParams> request = near_pairs(query);
  if (request && dch_takes(*request)) return request;
  wrapped_now();
  return std::nullopt;
}

/// Chooses anew, with hysteresis: between the two thresholds nothing changes.
void ContactFinder::measured(const ContactStats& stats) {
  since_measured_ = 0;
  const double beads = static_cast<double>(std::max<std::size_t>(necklace().size(), 1));
  choice_.visited_per_bead = static_cast<double>(stats.cage_pairs) / beads;
  const std::string figure = with_two_digits(choice_.visited_per_bead) + " visited pairs a bead";
  if (choice_.visited_per_bead > params_.to_dch) {
    choice_.structure = Structure::dch;
    choice_.reason = figure + ", above " + with_two_digits(params_.to_dch) + ": the DCH";
  } else if (choice_.visited_per_bead < params_.to_wrapped) {
    choice_.structure = Structure::wrapped;
    choice_.reason = figure + ", below " + with_two_digits(params_.to_wrapped) + ": the wrapped hierarchy";
  } else {
    choice_.reason = figure + ", between the thresholds: as before";
  }
}

void ContactFinder::place_beads() {
  by_place_.reserve(necklace().size());  // all or, without memory, none
  for (const std::int32_t particle : necklace().particle()) {
    by_place_.push_back(given_[static_cast<std::size_t>(particle)]);
  }
}

/// Refuses bonds as unwrap() does, at a fraction of its cost: only chains whose bonds are not plainly short
/// enough, or do not plainly sum up to nothing around a ring, are unwrapped.
void ContactFinder::require_determined() const {
  const double limit2 = (1 - 1e-9) * box_.max_cutoff() * box_.max_cutoff();
  const Chains& chains = necklace().chains();
  for (std::size_t chain = 0; chain < chains.size(); ++chain) {
    const auto first = static_cast<std::size_t>(necklace().first_place(chain));
    const auto end = static_cast<std::size_t>(necklace().first_place(chain + 1));
    Vec3 around;
    double longest2 = 0;
    const auto follow = [&](std::size_t from, std::size_t to) {
      const Vec3 bond = box_.nearest_image(by_place_[to] - by_place_[from]);
      around = around + bond;
      longest2 = std::max(longest2, norm2(bond));
    };
    for (std::size_t place = first + 1; place < end; ++place) follow(place - 1, place);
    if (chains.closed(chain)) follow(end - 1, first);
    if (longest2 < limit2 && (!chains.closed(chain) || norm2(around) < limit2)) continue;
    unwrap(chains, given_, box_);
    return;
  }
}

/// The list of the pairs of places that are near enough for a contact. None for what the DCH does not take
/// although the wrapped hierarchy does.
std::optional<ListParams> ContactFinder::near_pairs(const ContactQuery& query) const {
  const double gap = std::max(query.gap, 0.0);
  ListParams params;
  params.order = RowOrder::unsorted;
  if (smallest_radius_ < necklace().largest_radius()) {
    params.radii = radii_;
    params.skin = gap;
  } else {
    const double reach = 2 * smallest_radius_ + gap;
    if (reach == 0) return std::nullopt;  // contacts at one and the same place alone
    params.cutoffs = TypeCutoffs(reach);
  }
  // A little more, so that rounding loses nothing, where the box has room for it.
  ListParams wider = params;
  wider.skin += 1e-12 * params.list_radius();
  if (wider.list_radius() <= box_.max_cutoff()) params = wider;
  const double radius = params.list_radius();
  if (radius < kMinListRadius || radius > kMaxListRadius) return std::nullopt;
  return params;
}

/// Brings the DCH up to date. False for positions so far outside that their places in the box are uncertain.
bool ContactFinder::dch_takes(const ListParams& request) {
  const double radius = request.list_radius();
  const bool is_sized = !request.radii.empty() && necklace().largest_radius() > 2 * smallest_radius_;
  const bool fits = radius <= search_radius_ && search_radius_ <= std::min(2 * radius, box_.max_cutoff()) &&
                    (names_.empty() || is_sized == search_is_sized_);
  if (search_ == nullptr || !fits) {
    HierarchyParams structure;
    structure.radius = radius;
    structure.executor = params_.executor;
    structure.size_classes = is_sized;
    search_ = make_dch_search(structure);
    search_is_sized_ = is_sized;
    search_radius_ = radius;
    search_is_new_ = false;
  }
  if (search_is_new_) return true;
  try {
    search_->update(by_place_, box_, names_);
  } catch (const InvalidPosition&) {
    return false;
  }
  return search_is_new_ = true;
}

Contact ContactFinder::contact_at(std::int32_t p, std::int32_t q) const {
  const auto particle = necklace().particle();
  const auto i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
  const Vec3 d = box_.nearest_image(by_place_[j] - by_place_[i]);
  return detail::contact_of(particle[i], particle[j], by_place_[i], d, radii_[i], radii_[j]);
}

bool ContactFinder::by_dch(const ListParams& request, const ContactQuery& query, bool first_only,
                           std::vector<Contact>& out) {
  search_->list(request, list_);
  answered_by_ = Structure::dch;
  ++since_measured_;
  std::atomic<bool> any{false};
  std::mutex joining;
  detail::FoundPairs found(necklace().particle());
  for_ranges(params_.executor, list_.size(), [&](std::size_t first, std::size_t last) {
    detail::FoundPairs part(necklace().particle());
    for (std::size_t row = first; row < last && !(first_only && any); ++row) {
      const auto p = list_.particle.empty() ? static_cast<std::int32_t>(row) : list_.particle[row];
      const detail::BesidePlace beside(necklace(), query, p);
      const Vec3 at = by_place_[static_cast<std::size_t>(p)];
      const double radius = radii_[static_cast<std::size_t>(p)];
      for (const std::int32_t q : list_.row(row)) {
        // By the very formula of the hierarchies.
        const double reach = radius + radii_[static_cast<std::size_t>(q)] + query.gap;
        if (!(reach >= 0 && box_.distance2(at, by_place_[static_cast<std::size_t>(q)]) <= reach * reach))
          continue;
        if (!beside.asks_for(q)) continue;
        any.store(true, std::memory_order_relaxed);
        if (first_only) break;
        part.add(p, q);
      }
    }
    const std::lock_guard lock(joining);
    found.add(std::move(part));
  });
  if (first_only) return any;
  out = detail::contacts_of(found, params_.executor, [&](const detail::FoundPairs::Pair& pair) {
    return contact_at(pair.places[0], pair.places[1]);
  });
  return any;
}

}  // namespace dch::necklace

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/kinetic/contacts_between.hpp>

#include "argument_checks.hpp"
#include "box_change.hpp"
#include "geometry/position_check.hpp"
#include "pass_finder.hpp"

namespace dch::kinetic {
namespace {

/// Of the search structure over what the list at hand needs: it stays while lists need up to so much more.
constexpr double kSpare = 1.15, kMaxSpare = 1.5;
/// Squares of longer displacements may overflow.
constexpr double kLongest = kMaxMagnitude;

bool is_before(const PassingContact& x, const PassingContact& y) {
  return std::tie(x.i, x.j, x.enters) < std::tie(y.i, y.j, y.enters);
}

/// How far two points can be apart halfway if they come within the cutoff between the frames: their
/// displacements add (1 + 2 slack)/2 of their lengths, since the pair that is stretched along with the box is
/// (R + lengths)/(1 - strain) apart at most.
struct Reach {
  Reach(double cutoff, double strain, double error)
      : share(0.5 + 0.5 * strain / (1 - strain)), base((cutoff + error) * 2 * share) {}
  double share, base;
};

/// Contacts of a pair through several images become one where they overlap.
void merge(std::vector<PassingContact>& contacts) {
  std::sort(contacts.begin(), contacts.end(), is_before);
  std::size_t kept = 0;
  for (std::size_t k = 1; k < contacts.size(); ++k) {
    PassingContact& last = contacts[kept];
    if (contacts[k].enters > last.leaves) {
      contacts[++kept] = contacts[k];
      continue;
    }
    last.leaves = std::max(last.leaves, contacts[k].leaves);
    last.closest = std::min(last.closest, contacts[k].closest);
    last.is_shown_before = last.is_shown_before || contacts[k].is_shown_before;
    last.is_shown_after = last.is_shown_after || contacts[k].is_shown_after;
  }
  if (!contacts.empty()) contacts.resize(kept + 1);
}

bool lasts(const PassingContact& contact) { return contact.is_shown_before && contact.is_shown_after; }

}  // namespace

struct ContactsBetween::Impl {
  double cutoff;
  std::string engine;
  Executor* executor;
  std::unique_ptr<PairSearch> search;  ///< of points halfway; none before the first interval
  double search_radius = 0;
  PassingContacts found;
  std::vector<Vec3> slips, places;            ///< by point: displacement beyond the box's, and place halfway
  std::vector<std::int32_t> near, far;        ///< points for the list, and those whose way is too long for it
  std::vector<Vec3> near_slips, near_places;  ///< by number in `near`
  std::vector<double> radii;
  NeighborList list;
  std::vector<std::vector<PassingContact>> parts;
  std::vector<std::int64_t> looked_at;

  void move(const BoxChange& change, Span<const Vec3> before, Span<const Vec3> after);
  void sort_by_way(const BoxChange& change, const Reach& reach);
  void make_list(const Box& middle);
  void look_at_list(const BoxChange& change, const PassFinder& passes);
  void look_at_far(const BoxChange& change, const Reach& reach, const PassFinder& passes);
  void look_at_images(const BoxChange& change, const Reach& reach, const PassFinder& passes, std::int32_t i,
                      std::int32_t j, std::vector<PassingContact>& out);
};

ContactsBetween::ContactsBetween(double cutoff, std::string engine, Executor* executor)
    : impl_(
          new Impl{cutoff, std::move(engine), executor, {}, 0, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}) {
  check_length(cutoff, "cutoff");
  HierarchyParams params;
  params.radius = cutoff;
  make_search(impl_->engine, params);  // whether there is such an engine
}
ContactsBetween::~ContactsBetween() = default;
ContactsBetween::ContactsBetween(ContactsBetween&&) noexcept = default;
ContactsBetween& ContactsBetween::operator=(ContactsBetween&&) noexcept = default;

const PassingContacts& ContactsBetween::find(Span<const Vec3> before, const Box& box_before,
                                             Span<const Vec3> after, const Box& box_after) {
  Impl& all = *impl_;
  all.found = {};
  if (before.size() != after.size()) {
    throw InvalidParameter("there are " + std::to_string(before.size()) + " positions before and " +
                           std::to_string(after.size()) + " after; give those of the same points");
  }
  const double far_out =
      detail::check_positions(before, box_before) + detail::check_positions(after, box_after);
  detail::check_radius(all.cutoff, box_before);
  detail::check_radius(all.cutoff, box_after);
  const BoxChange change(box_before, box_after);
  all.found.undetermined = change.fault();
  if (!change.fault().empty()) return all.found;
  all.move(change, before, after);
  double largest = 0;
  for (const Vec3 p : all.places) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const detail::WrapError wrapping(change.middle());
  const double error = 4 * wrapping.bound(far_out) + 1e-12 * all.cutoff +
                       64 * std::numeric_limits<double>::epsilon() * (largest + far_out);
  const Reach reach(all.cutoff, change.strain(), error);
  all.sort_by_way(change, reach);
  const PassFinder passes(all.cutoff, error, before, box_before, after, box_after);
  all.make_list(change.middle());
  all.look_at_list(change, passes);
  all.look_at_far(change, reach, passes);
  std::sort(all.found.contacts.begin(), all.found.contacts.end(), is_before);
  return all.found;
}

void ContactsBetween::Impl::move(const BoxChange& change, Span<const Vec3> before, Span<const Vec3> after) {
  slips.resize(before.size());
  places.resize(before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    slips[k] = change.displacement(before[k], after[k]);
    if (change.is_ambiguous(slips[k]) || !(norm2(slips[k]) <= kLongest * kLongest))
      found.undetermined_points.push_back(static_cast<std::int32_t>(k));
    places[k] = change.middle().wrap(change.middle_of(before[k], slips[k]));
  }
}

/// Points with a way that fits into a list of the box halfway, and the others.
void ContactsBetween::Impl::sort_by_way(const BoxChange& change, const Reach& reach) {
  const double room = (1 - 1e-9) * std::min(change.middle().max_cutoff(), 1e-2 * kMaxListRadius) - reach.base;
  near.clear();
  far.clear();
  radii.clear();
  near_slips.clear();
  near_places.clear();
  auto undetermined = found.undetermined_points.begin();
  for (std::size_t k = 0; k < slips.size(); ++k) {
    const auto id = static_cast<std::int32_t>(k);
    if (undetermined != found.undetermined_points.end() && *undetermined == id) {
      ++undetermined;
      continue;
    }
    const double way = 2 * reach.share * std::sqrt(norm2(slips[k]));
    if (!(way <= room)) {
      far.push_back(id);
      continue;
    }
    near.push_back(id);
    radii.push_back(0.5 * (reach.base + way));
    near_slips.push_back(slips[k]);
    near_places.push_back(places[k]);
  }
}

void ContactsBetween::Impl::make_list(const Box& middle) {
  list = {};
  if (near.empty()) return;
  ListParams params;
  params.radii = radii;
  params.order = RowOrder::by_structure;
  params.superset = true;
  const double radius = params.list_radius();
  if (!search || search_radius < radius || search_radius > kMaxSpare * radius ||
      search_radius > middle.max_cutoff()) {
    HierarchyParams structure;
    structure.radius = std::min(kSpare * radius, middle.max_cutoff());
    structure.executor = executor;
    search = make_search(engine, structure);
    search_radius = structure.radius;
  }
  search->update(near_places, middle);
  search->list(params, list);
}

void ContactsBetween::Impl::look_at_list(const BoxChange& change, const PassFinder& passes) {
  const int count = executor != nullptr ? executor->threads() : 1;
  parts.assign(static_cast<std::size_t>(count), {});
  looked_at.assign(static_cast<std::size_t>(count), 0);
  const Box& box = change.middle();
  const auto look_at_part = [&](int part) {
    std::vector<PassingContact>& out = parts[static_cast<std::size_t>(part)];
    std::int64_t pairs = 0;
    for (auto row = share_begin(list.size(), part, count); row < share_begin(list.size(), part + 1, count);
         ++row) {
      const auto i = list.particle.empty() ? row : static_cast<std::size_t>(list.particle[row]);
      const Vec3 place = near_places[i], slip = near_slips[i];
      for (const std::int32_t neighbor : list.row(row)) {
        const auto j = static_cast<std::size_t>(neighbor);
        const Vec3 apart = box.nearest_image(near_places[j] - place);
        const auto contact = passes.find(near[i], near[j], apart, change.rate(apart, near_slips[j] - slip));
        if (contact && !lasts(*contact)) out.push_back(*contact);
      }
      pairs += static_cast<std::int64_t>(list.row(row).size());
    }
    looked_at[static_cast<std::size_t>(part)] = pairs;
  };
  if (count == 1) {
    look_at_part(0);
  } else {
    executor->run(count, look_at_part);
  }
  for (std::size_t part = 0; part < parts.size(); ++part) {
    found.contacts.insert(found.contacts.end(), parts[part].begin(), parts[part].end());
    found.candidates += looked_at[part];
  }
}

void ContactsBetween::Impl::look_at_far(const BoxChange& change, const Reach& reach,
                                        const PassFinder& passes) {
  std::vector<PassingContact> of_pair;
  const auto look_at_pair = [&](std::int32_t i, std::int32_t j) {
    of_pair.clear();
    look_at_images(change, reach, passes, i, j, of_pair);
    merge(of_pair);
    for (const PassingContact& contact : of_pair)
      if (!lasts(contact)) found.contacts.push_back(contact);
    ++found.candidates;
  };
  for (std::size_t k = 0; k < far.size(); ++k) {
    for (std::size_t other = k + 1; other < far.size(); ++other) look_at_pair(far[k], far[other]);
    for (const std::int32_t other : near) look_at_pair(far[k], other);
  }
}

/// All images that can come within the cutoff: along a period, they lie within the reach of the ways.
void ContactsBetween::Impl::look_at_images(const BoxChange& change, const Reach& reach,
                                           const PassFinder& passes, std::int32_t i, std::int32_t j,
                                           std::vector<PassingContact>& out) {
  const Box& box = change.middle();
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  const Vec3 nearest = box.nearest_image(places[b] - places[a]), slip = slips[b] - slips[a];
  const double limit = reach.base + reach.share * (std::sqrt(norm2(change.along_periods(slips[a]))) +
                                                   std::sqrt(norm2(change.along_periods(slips[b]))));
  int least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
  for (int axis = 0; axis < box.rank(); ++axis) {
    const Vec3 dual = box.reduced_dual()[static_cast<std::size_t>(axis)];
    const double at = dot(nearest, dual), heights = limit * std::sqrt(norm2(dual)) + 1e-9;
    least[axis] = static_cast<int>(std::ceil(-at - heights));
    most[axis] = static_cast<int>(std::floor(-at + heights));
  }
  const auto& period = box.reduced();
  for (int x = least[0]; x <= most[0]; ++x)
    for (int y = least[1]; y <= most[1]; ++y)
      for (int z = least[2]; z <= most[2]; ++z) {
        const Vec3 apart = nearest + x * period[0] + y * period[1] + z * period[2];
        if (const auto contact = passes.find(i, j, apart, change.rate(apart, slip))) out.push_back(*contact);
      }
}

}  // namespace dch::kinetic

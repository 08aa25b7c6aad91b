// SPDX-License-Identifier: MIT
// Contacts between frames against all pairs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engines/verifier.hpp"

namespace dch::cli {
namespace {

/// Roots of contacts that hardly come within the cutoff are off by this at most.
constexpr double kTimeError = 1e-5;

/// What rounding of coordinates may do to distances, far more than it does.
double slack_of(const Verifier::Interval& interval) {
  double largest = 0;
  for (const Span<const Vec3> positions : {interval.before, interval.after})
    for (const Vec3 p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 1e-10 * interval.cutoff + 256 * std::numeric_limits<double>::epsilon() * largest;
}

bool is_same(const BetweenContact& found, const kinetic::OracleContact& expected, double slack) {
  if (std::abs(found.closest - expected.closest) > 10 * slack) return false;
  return expected.margin <= 10 * slack || (std::abs(found.enters - expected.enters) < kTimeError &&
                                           std::abs(found.leaves - expected.leaves) < kTimeError);
}

}  // namespace

void Verifier::check_between(const Interval& interval) {
  if (result_.mode == VerifyMode::none) return;
  if (result_.mode == VerifyMode::sample && !sampled_intervals_.contains(interval.ordinal)) return;
  result_.intervals.push_back(interval.frame);
  const double slack = slack_of(interval);
  std::vector<std::int32_t> sample;
  if (result_.mode == VerifyMode::sample) sample = sample_atoms(interval.ids.size());
  auto expected =
      kinetic::all_hidden_contacts(interval.cutoff, slack, interval.before, *interval.box_before,
                                   interval.after, *interval.box_after, interval.undetermined, sample);
  std::erase_if(expected, [&](const kinetic::OracleContact& contact) {
    return interval.exclusions->excluded(interval.places[static_cast<std::size_t>(contact.i)],
                                         interval.places[static_cast<std::size_t>(contact.j)]);
  });
  std::vector<std::int64_t> sampled_ids;
  sampled_ids.reserve(sample.size());
  for (const std::int32_t atom : sample) sampled_ids.push_back(interval.ids[static_cast<std::size_t>(atom)]);
  std::sort(sampled_ids.begin(), sampled_ids.end());
  const auto is_sampled = [&](std::int64_t id) {
    return sample.empty() || std::binary_search(sampled_ids.begin(), sampled_ids.end(), id);
  };
  std::vector<BetweenContact> found;
  for (const BetweenContact& contact : interval.contacts)
    if (contact.is_hidden && (is_sampled(contact.i) || is_sampled(contact.j))) found.push_back(contact);
  // Both are in the order of i, j and time: pair by pair
  const auto pair_of = [&](const kinetic::OracleContact& contact) {
    return std::pair(interval.ids[static_cast<std::size_t>(contact.i)],
                     interval.ids[static_cast<std::size_t>(contact.j)]);
  };
  for (std::size_t f = 0, e = 0; f < found.size() || e < expected.size();) {
    auto pair = e < expected.size() ? pair_of(expected[e]) : std::pair(found[f].i, found[f].j);
    if (f < found.size()) pair = std::min(pair, std::pair(found[f].i, found[f].j));
    const std::size_t first_found = f, first_expected = e;
    while (f < found.size() && std::pair(found[f].i, found[f].j) == pair) ++f;
    while (e < expected.size() && pair_of(expected[e]) == pair) ++e;
    compare_pair(interval, {found.data() + first_found, f - first_found},
                 {expected.data() + first_expected, e - first_expected}, slack);
  }
}

/// A contact that all pairs leave no doubt about has to be found, and one that is found has to be one of
/// theirs.
void Verifier::compare_pair(const Interval& interval, Span<const BetweenContact> found,
                            Span<const kinetic::OracleContact> expected, double slack) {
  const auto note = [&](const char* what, std::int64_t i, std::int64_t j, double distance) {
    Mismatch mismatch;
    mismatch.frame = interval.frame;
    mismatch.next_frame = interval.next_frame;
    mismatch.what = what;
    mismatch.atom_a = i;
    mismatch.atom_b = j;
    mismatch.distance = distance;
    report(std::move(mismatch));
  };
  for (const kinetic::OracleContact& contact : expected) {
    const bool is_found = std::any_of(found.begin(), found.end(), [&](const BetweenContact& other) {
      return is_same(other, contact, slack);
    });
    if (!is_found && contact.margin > slack) {
      note("hidden missing", interval.ids[static_cast<std::size_t>(contact.i)],
           interval.ids[static_cast<std::size_t>(contact.j)], contact.closest);
    }
  }
  for (const BetweenContact& contact : found) {
    const bool is_expected = std::any_of(expected.begin(), expected.end(),
                                         [&](const auto& other) { return is_same(contact, other, slack); });
    if (!is_expected) note("hidden extra", contact.i, contact.j, contact.closest);
  }
}

}  // namespace dch::cli

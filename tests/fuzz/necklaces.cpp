// SPDX-License-Identifier: MIT
//
// Contacts of chains: the same from every structure and by brute force, under motion, with a certificate that
// holds.
#include <dch/base/error.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/layered_hierarchy.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contact_oracle.hpp"
#include "fuzz_scene.hpp"

namespace dch::fuzz {
namespace {

using necklace::Chains;
using necklace::ContactFinder;
using necklace::ContactQuery;
using necklace::Necklace;
using necklace::WrappedHierarchy;

constexpr std::size_t kMaxBeads = 60;

/// Chains of beads one after the other, open and closed, and some particles in none.
Chains choose_chains(FuzzInput& input, std::size_t particles) {
  Chains chains(particles);
  std::vector<std::int32_t> beads;
  for (std::size_t k = 0; k < particles; ++k) {
    const std::size_t what = input.below(8);
    if (what != 1) beads.push_back(static_cast<std::int32_t>(k));
    if ((what < 2 || k + 1 == particles) && !beads.empty()) {
      chains.add(beads, beads.size() >= 3 && input.coin());
      beads.clear();
    }
  }
  return chains;
}

/// Walks that stay where they are at times, and jump.
std::vector<Vec3> choose_positions(FuzzInput& input, const Box& box, std::size_t count) {
  std::vector<Vec3> positions;
  for (std::size_t k = 0; k < count; ++k) {
    const bool jumps = positions.empty() || input.below(16) == 15;
    positions.push_back(
        jumps ? scenes::from_fractional(box, {input.uniform(), input.uniform(), input.uniform()})
              : positions.back() + input.in_cube(0.8));
  }
  return positions;
}

ContactQuery choose_query(FuzzInput& input) {
  ContactQuery query;
  query.gap = input.coin() ? 0 : input.uniform(-0.2, 0.6);
  query.skip_bonds = static_cast<int>(input.below(5));
  const std::size_t pairs = input.below(4);
  query.within_chains = pairs != 1;
  query.between_chains = pairs != 2;
  return query;
}

void compare(WrappedHierarchy& wrapped, ContactFinder& finder, const std::vector<Vec3>& positions,
             const Box& box, const ContactQuery& query) {
  const auto expected = test::contact_oracle(wrapped.necklace(), positions, box, query);
  wrapped.update(positions, box);
  if (test::pairs_of(find_contacts(wrapped, query)) != expected) fail("find_contacts() beside all pairs");
  if (any_contact(wrapped, query) == expected.empty()) fail("any_contact() beside all pairs");
  finder.update(positions, box);
  if (test::pairs_of(finder.find_contacts(query)) != expected) fail("ContactFinder beside all pairs");
  necklace::LayeredHierarchy layered(wrapped.necklace());
  layered.update(positions, box);
  if (test::pairs_of(find_contacts(layered, query)) != expected)
    fail("the layered hierarchy beside all pairs");
  const auto separation = separate(wrapped, query);
  if (test::pairs_of(separation.contacts) != expected) fail("separate() beside all pairs");
  require_none(check_certificate(wrapped, query, separation), "certificate");
}

void run(FuzzInput& input) {
  const Box box = choose_box(input);
  const std::size_t count = 1 + input.below(kMaxBeads);
  const double largest = std::min(0.8, 0.2 * box.max_cutoff()) * input.uniform();
  std::vector<double> radii(count);
  for (double& radius : radii) radius = largest * std::pow(20, -input.uniform());
  const Necklace necklace(choose_chains(input, count), radii);
  ContactQuery query = choose_query(input);
  query.gap = std::min(query.gap, 0.9 * (box.max_cutoff() - 2 * largest));
  auto positions = choose_positions(input, box, count);
  WrappedHierarchy wrapped(necklace, {input.coin() ? 1 : 8, input.coin() ? necklace::Verification::watched
                                                                         : necklace::Verification::cascade});
  necklace::ContactFinderParams params;
  params.to_dch = 4 * input.uniform();
  params.to_wrapped = params.to_dch / 2;
  ContactFinder finder(necklace, params);
  for (int step = 0; step < 3; ++step) {
    compare(wrapped, finder, positions, box, query);
    if (input.empty()) break;
    move_points(input, 0.2, positions);
  }
}

}  // namespace
}  // namespace dch::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  dch::fuzz::FuzzInput input(data, size);
  dch::fuzz::run(input);
  return 0;
} catch (const dch::InvalidBox&) {
  return 0;  // the free vectors made no box
} catch (const dch::necklace::Undetermined&) {
  return 0;  // a chain whose course the images do not tell
}

// SPDX-License-Identifier: MIT
#include "analysis/bead_places.hpp"

#include <string>

#include <dch/base/error.hpp>

namespace dch::necklace::detail {

namespace {

std::int32_t place_of(std::int32_t particle, Span<const std::int32_t> by_particle) {
  const bool exists = particle >= 0 && static_cast<std::size_t>(particle) < by_particle.size();
  const std::int32_t place = exists ? by_particle[static_cast<std::size_t>(particle)] : -1;
  if (place < 0) {
    throw InvalidParameter("a contact names the particle " + std::to_string(particle) +
                           ", which stands in no chain of the necklace; give contacts of its beads");
  }
  return place;
}

}  // namespace

std::vector<std::int32_t> places_by_particle(const Necklace& necklace) {
  std::vector<std::int32_t> places(necklace.particles(), -1);
  const auto particles = necklace.particle();
  for (std::size_t place = 0; place < particles.size(); ++place) {
    places[static_cast<std::size_t>(particles[place])] = static_cast<std::int32_t>(place);
  }
  return places;
}

std::array<std::int32_t, 2> places_of(const Contact& contact, Span<const std::int32_t> by_particle) {
  return {place_of(contact.i, by_particle), place_of(contact.j, by_particle)};
}

}  // namespace dch::necklace::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/necklace.hpp>

namespace dch::necklace::detail {

/// By particle: its place, -1 for one in no chain. The inverse of Necklace::particle().
std::vector<std::int32_t> places_by_particle(const Necklace& necklace);

/// Places of the two beads of a contact.
/// @throws InvalidParameter if one of them is no bead.
std::array<std::int32_t, 2> places_of(const Contact& contact, Span<const std::int32_t> by_particle);

}  // namespace dch::necklace::detail

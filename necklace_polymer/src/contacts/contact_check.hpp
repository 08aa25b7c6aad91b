// SPDX-License-Identifier: MIT
#pragma once

#include <dch/geometry/box.hpp>
#include <dch/necklace/contacts.hpp>

namespace dch::necklace::detail {

/// Refuses what no search can answer.
/// @throws InvalidParameter, CutoffTooLarge as any_contact() says.
void check_query(const Necklace& necklace, const Box& box, const ContactQuery& query);

}  // namespace dch::necklace::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <dch/lists/list_params.hpp>

namespace dch::detail {

/// @throws InvalidParameter if the skin is negative or not finite.
void check_skin(double skin);

/// Checks that params ask for something a structure of n particles and of the given search radius can answer.
/// @throws InvalidParameter as PairSearch::list says.
void check_list_params(const ListParams& params, std::size_t n, double radius);

}  // namespace dch::detail

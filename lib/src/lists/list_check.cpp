// SPDX-License-Identifier: MIT
#include "lists/list_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"

namespace dch::detail {
namespace {

void check_radii(const ListParams& params, std::size_t n) {
  if (params.radii.size() != n) {
    throw InvalidParameter(std::to_string(params.radii.size()) + " radii given for " + std::to_string(n) +
                           " particles; give one each");
  }
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = params.radii[i];
    if (!(std::isfinite(radius) && radius >= 0)) {
      throw InvalidParameter("particle " + std::to_string(i) + " has the radius " + describe(radius) +
                             "; a radius must be finite and not negative");
    }
    largest = std::max(largest, radius);
  }
  if (largest == 0) throw InvalidParameter("every radius is 0; at least one must be > 0");
}

void check_types(const ListParams& params, std::size_t n) {
  const int types = params.cutoffs.types();
  if (params.types.empty() && (types == 1 || n == 0)) return;
  if (params.types.size() != n) {
    throw InvalidParameter(std::to_string(params.types.size()) + " particle types given for " +
                           std::to_string(n) + " particles; give one each");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (params.types[i] < 0 || params.types[i] >= types) {
      throw InvalidParameter("particle " + std::to_string(i) + " has type " +
                             std::to_string(params.types[i]) + ", but the cutoffs are for types 0 to " +
                             std::to_string(types - 1));
    }
  }
}

}  // namespace

void check_skin(double skin) {
  if (!(std::isfinite(skin) && skin >= 0)) {
    throw InvalidParameter("the skin is " + describe(skin) + "; it must be finite and not negative");
  }
}

void check_list_params(const ListParams& params, std::size_t n, double radius) {
  check_skin(params.skin);
  if (!(std::isfinite(params.shell) && params.shell >= 0 &&
        (params.radii.empty() || params.shell <= params.skin))) {
    throw InvalidParameter(
        "the shell is " + describe(params.shell) +
        "; it must be finite, not negative and, where there are radii, not more than the skin");
  }
  if (!params.radii.empty()) check_radii(params, n);
  if (!(std::isfinite(params.cutoff_error()) && params.cutoff_error() >= 0)) {
    throw InvalidParameter("the error of the test near the cutoff is " + describe(params.cutoff_error()) +
                           "; it must be finite and not negative");
  }
  const double reach = params.list_radius() + params.cutoff_error();
  if (reach > radius) {
    throw InvalidParameter(std::string("cutoff + skin") + (params.tie_breaker ? " + error" : "") + " = " +
                           describe(reach) + " exceeds the search radius " + describe(radius) +
                           " that the engine was made for; make it with a larger one");
  }
  if (params.radii.empty()) check_types(params, n);
  if (params.exclusions != nullptr && !params.exclusions->empty() && params.exclusions->size() != n) {
    throw InvalidParameter("exclusions made for " + std::to_string(params.exclusions->size()) +
                           " particles do not fit " + std::to_string(n) + " particles");
  }
  if (params.first_ghost >= 0 && static_cast<std::size_t>(params.first_ghost) > n) {
    throw InvalidParameter("the first ghost is particle " + std::to_string(params.first_ghost) +
                           ", but there are only " + std::to_string(n) + " particles");
  }
}

}  // namespace dch::detail

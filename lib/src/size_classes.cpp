// SPDX-License-Identifier: MIT
#include "size_classes.hpp"

#include <algorithm>
#include <cmath>

namespace dch::detail {
namespace {

/// Largest ratio of sizes in a class. Smaller: more classes to look through; larger: more pairs of small
/// particles looked at with the reach of larger ones.
constexpr double kRatio = 1.8;

/// List radius of each particle with its equals; of a type that has no pairs with itself, the smallest one
/// with another type.
class Sizes {
 public:
  explicit Sizes(const ListParams& params) : params_(params) {
    if (!params.radii.empty()) return;
    const int types = params.cutoffs.types();
    for (int a = 0; a < types; ++a) {
      double cutoff = params.cutoffs(a, a);
      for (int b = 0; b < types && params.cutoffs(a, a) == 0; ++b) {
        const double other = params.cutoffs(a, b);
        if (other > 0 && (cutoff == 0 || other < cutoff)) cutoff = other;
      }
      of_type_.push_back(cutoff + params.skin);
    }
  }
  double operator[](std::size_t i) const {
    if (!params_.radii.empty()) return 2 * params_.radii[i] + params_.skin;
    return of_type_.size() == 1 ? of_type_[0] : of_type_[static_cast<std::size_t>(params_.types[i])];
  }

 private:
  const ListParams& params_;
  std::vector<double> of_type_;
};

void widen_by_radii(const ListParams& params, SizeClasses& classes) {
  std::vector<double> largest(classes.count, 0.0);
  for (std::size_t i = 0; i < classes.of.size(); ++i)
    largest[classes.of[i]] = std::max(largest[classes.of[i]], params.radii[i]);
  for (std::size_t a = 0; a < classes.count; ++a)
    for (std::size_t b = 0; b < classes.count; ++b)
      classes.reach[a * classes.count + b] =
          std::max(classes.reach[a * classes.count + b], largest[a] + largest[b] + params.skin);
}

void widen_by_types(const ListParams& params, SizeClasses& classes) {
  const auto types = static_cast<std::size_t>(params.cutoffs.types());
  std::vector<char> has(classes.count * types, 0);
  for (std::size_t i = 0; i < classes.of.size(); ++i)
    has[classes.of[i] * types + (types == 1 ? 0 : static_cast<std::size_t>(params.types[i]))] = 1;
  for (std::size_t a = 0; a < classes.count; ++a)
    for (std::size_t b = 0; b < classes.count; ++b)
      for (std::size_t s = 0; s < types; ++s)
        for (std::size_t t = 0; t < types; ++t) {
          if (!has[a * types + s] || !has[b * types + t]) continue;
          double& reach = classes.reach[a * classes.count + b];
          const double cutoff = params.cutoffs(static_cast<int>(s), static_cast<int>(t));
          if (cutoff > 0) reach = std::max(reach, cutoff + params.skin);
        }
}

}  // namespace

SizeClasses::SizeClasses(Span<const ListParams> requests, std::size_t n, double farthest) : of(n, 0) {
  const bool can_be_told_apart =
      std::all_of(requests.begin(), requests.end(),
                  [&](const ListParams& request) { return request.list_radius() < farthest; });
  if (n > 0 && can_be_told_apart) {
    const Sizes size(requests[0]);
    double smallest = size[0];
    for (std::size_t i = 0; i < n; ++i) smallest = std::min(smallest, size[i]);
    std::vector<std::int32_t> rank_of;  // by power of the ratio: first which occur, then their class
    for (std::size_t i = 0; i < n && smallest > 0; ++i) {
      of[i] = static_cast<std::int32_t>(std::log(size[i] / smallest) / std::log(kRatio));
      if (static_cast<std::size_t>(of[i]) >= rank_of.size())
        rank_of.resize(static_cast<std::size_t>(of[i]) + 1, -1);
      rank_of[of[i]] = 0;
    }
    std::int32_t classes = 0;
    for (std::int32_t& rank : rank_of)
      if (rank == 0) rank = classes++;
    if (classes > 0) count = static_cast<std::size_t>(classes);
    for (std::size_t i = 0; i < n && classes > 0; ++i) of[i] = rank_of[of[i]];
  }
  reach.assign(count * count, 0.0);
  for (const ListParams& request : requests) {
    if (request.radii.empty()) {
      widen_by_types(request, *this);
    } else {
      widen_by_radii(request, *this);
    }
  }
}

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#include "engines/size_classes.hpp"

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

bool SizeRecord::has_sizes_of(const ListParams& request, const ListParams& other) {
  return request.radii.data() == other.radii.data() && request.radii.size() == other.radii.size() &&
         request.types.data() == other.types.data() && request.types.size() == other.types.size();
}

bool SizeRecord::says_the_same(Span<const ListParams> requests) const {
  if (requests.size() != each_.size()) return false;
  for (std::size_t r = 0; r < each_.size(); ++r) {
    const Request& kept = each_[r];
    const ListParams& request = requests[r];
    if (request.skin != kept.skin || !(request.cutoffs == kept.cutoffs)) return false;
    if (kept.has_sizes_of_first) {
      if (!has_sizes_of(request, requests[0])) return false;
    } else if (!std::equal(request.radii.begin(), request.radii.end(), kept.radii.begin(),
                           kept.radii.end()) ||
               !std::equal(request.types.begin(), request.types.end(), kept.types.begin(),
                           kept.types.end())) {
      return false;
    }
  }
  return true;
}

void SizeRecord::keep(Span<const ListParams> requests) {
  std::vector<Request> each;
  for (const ListParams& request : requests) {
    const bool known = !each.empty() && has_sizes_of(request, requests[0]);
    each.push_back({request.skin, request.cutoffs, {}, {}, known});
    if (known) continue;
    each.back().radii.assign(request.radii.begin(), request.radii.end());
    each.back().types.assign(request.types.begin(), request.types.end());
  }
  each_.swap(each);
}

std::size_t SizeRecord::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Request& request : each_)
    bytes += request.radii.capacity() * sizeof(double) + request.types.capacity() * sizeof(std::int32_t);
  return bytes;
}

/// Classes between powers of the ratio; those that no particle is in are left out.
template <class Size>
void SizeClasses::divide(const Size& size, double smallest, double largest) {
  std::vector<double> bounds;
  double next = kRatio * smallest;
  while (next <= largest) {
    bounds.push_back(next);
    next *= kRatio;
  }
  std::vector<std::int32_t> class_of(bounds.size() + 1, -1);  // first 0 where there are particles
  for (std::size_t i = 0; i < of.size(); ++i) {
    const double own = size[i];
    std::int32_t below = 0;
    for (const double bound : bounds) below += own >= bound;
    of[i] = below;
    class_of[below] = 0;
  }
  std::int32_t classes = 0;
  for (std::int32_t& number : class_of)
    if (number == 0) number = classes++;
  count = static_cast<std::size_t>(classes);
  for (std::int32_t& number : of) number = class_of[number];
}

SizeClasses::SizeClasses(Span<const ListParams> requests, std::size_t n, bool told_apart)
    : count(1), of(n, 0) {
  if (n > 0 && told_apart) {
    const Sizes size(requests[0]);
    double smallest = size[0], largest = size[0];
    for (std::size_t i = 0; i < n; ++i) {
      smallest = std::min(smallest, size[i]);
      largest = std::max(largest, size[i]);
    }
    if (smallest > 0) divide(size, smallest, largest);
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

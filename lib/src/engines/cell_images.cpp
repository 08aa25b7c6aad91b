// SPDX-License-Identifier: MIT
#include "engines/cell_images.hpp"

#include <algorithm>
#include <cmath>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "geometry/dual_basis.hpp"

namespace dch::detail {
namespace {

/// Fractional coordinates round; images that need not be there do no harm.
constexpr double kRoom = 1e-9;
/// More images than this along a vector are refused by their number, which the integers have to hold.
constexpr double kMostImages = 1e15;

std::int64_t first_from(double f) { return static_cast<std::int64_t>(std::ceil(std::max(f, -kMostImages))); }
std::int64_t last_to(double f) { return static_cast<std::int64_t>(std::floor(std::min(f, kMostImages))); }

}  // namespace

HomeImages::Shift shift_of(Vec3 integers) {
  HomeImages::Shift shift{};
  for (int axis = 0; axis < 3; ++axis) {
    const double n = integers[axis];
    if (!(std::abs(n) <= HomeImages::kMostPeriods))
      throw InvalidPosition("an image is " + describe(n) + " periods of the box away, and " +
                            describe(HomeImages::kMostPeriods) +
                            " are possible at most: wrap the coordinates first, or give a reduced cell");
    shift[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(n);
  }
  return shift;
}

HomeImages::HomeImages(Span<const Vec3> given, const Box& box)
    : positions(given.begin(), given.end()), shifts(given.size()) {
  if (!box.any_periodic()) return;
  const Lattice lattice(box);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = box.wrap(given[i]);
    if (positions[i] != given[i]) shifts[i] = shift_of(lattice.integers(positions[i] - given[i]));
  }
}

CellImages::CellImages(const Box& box, const Multiples& low, const Multiples& high) : low_(low) {
  for (std::size_t k = 0; k < 3; ++k) width_[k] = high[k] - low[k] + 1;
  const Lattice lattice(box);
  std::array<Vec3, 3> integers{};
  for (std::size_t k = 0; k < 3; ++k) integers[k] = lattice.integers(box.reduced()[k]);
  for (std::int64_t a = low[0]; a <= high[0]; ++a)
    for (std::int64_t b = low[1]; b <= high[1]; ++b)
      for (std::int64_t c = low[2]; c <= high[2]; ++c) {
        const Vec3 n = static_cast<double>(a) * integers[0] + static_cast<double>(b) * integers[1] +
                       static_cast<double>(c) * integers[2];
        shifts_.push_back(shift_of(n));
        vectors_.push_back(lattice.vector(n));
      }
}

double CellImages::count(const Multiples& low, const Multiples& high) {
  double images = 1;
  for (std::size_t k = 0; k < 3; ++k) images *= static_cast<double>(high[k] - low[k] + 1);
  return images;
}

GhostImages::GhostImages(const HomeImages& home, const Box& box, double reach)
    : home_(home),
      rank_(static_cast<std::size_t>(box.rank())),
      origin_(box.origin()),
      dual_(box.reduced_dual()) {
  for (std::size_t k = 0; k < rank_; ++k) {
    double least = 0, most = 0;
    for (std::size_t i = 0; i < home.positions.size(); ++i) {
      const double f = dot(dual_[k], home.positions[i] - origin_);
      least = i == 0 ? f : std::min(least, f);
      most = i == 0 ? f : std::max(most, f);
    }
    const double room = reach * norm(dual_[k]) + kRoom;
    least_[k] = least - room;
    most_[k] = most + room;
    low_[k] = first_from(least_[k] - most);
    high_[k] = last_to(most_[k] - least);
  }
  for (const Vec3 p : home.positions) {
    double images = 1;
    for (const Range& range : ranges(p)) images *= static_cast<double>(range.high - range.low + 1);
    ghosts_ += images - 1;
  }
}

std::array<GhostImages::Range, 3> GhostImages::ranges(Vec3 p) const {
  std::array<Range, 3> out{};
  for (std::size_t k = 0; k < rank_; ++k) {
    const double f = dot(dual_[k], p - origin_);
    out[k] = {first_from(least_[k] - f), last_to(most_[k] - f)};
  }
  return out;
}

void GhostImages::add(const CellImages& images, std::vector<Vec3>& positions,
                      std::vector<std::int32_t>& particle, std::vector<std::uint32_t>& image) const {
  for (std::size_t i = 0; i < home_.positions.size(); ++i) {
    const auto [r0, r1, r2] = ranges(home_.positions[i]);
    for (std::int64_t a = r0.low; a <= r0.high; ++a)
      for (std::int64_t b = r1.low; b <= r1.high; ++b)
        for (std::int64_t c = r2.low; c <= r2.high; ++c) {
          if (a == 0 && b == 0 && c == 0) continue;
          const std::size_t number = images.number({a, b, c});
          positions.push_back(home_.positions[i] + images.vectors()[number]);
          particle.push_back(static_cast<std::int32_t>(i));
          image.push_back(static_cast<std::uint32_t>(number));
        }
  }
}

}  // namespace dch::detail

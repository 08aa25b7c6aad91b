// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/langevin.hpp>

#include "same_count.hpp"
#include "simd/force_kernels.hpp"
#include "simd/philox.hpp"
#include "simd/ranmar.hpp"

namespace dch {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < detail::kPhiloxRounds; ++round) {
    const std::uint64_t even = std::uint64_t{detail::kPhiloxFactors[0]} * counter[0];
    const std::uint64_t odd = std::uint64_t{detail::kPhiloxFactors[1]} * counter[2];
    counter = {static_cast<std::uint32_t>(odd >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(odd),
               static_cast<std::uint32_t>(even >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(even)};
    for (std::size_t k = 0; k < 2; ++k) key[k] += detail::kPhiloxSteps[k];
  }
  return counter;
}

void uniform_noise(std::uint32_t seed, std::int64_t step, Span<const std::int32_t> ids, Span<Vec3> noise) {
  detail::require_same_count(ids.size(), "IDs", noise.size(), "places for noise");
  if (ids.empty()) return;
  detail::force_kernels(instruction_set())
      .noise.uniform({seed, static_cast<std::uint64_t>(step), ids.data(), ids.size(), noise.data()});
}

RanmarNoise::RanmarNoise(int seed) : shift_(detail::next_ranmar_shift(detail::kRanmarFirstShift)) {
  if (seed < 1 || seed > 900000000)
    throw InvalidParameter("the seed is " + std::to_string(seed) + " but has to be from 1 to 900000000");
  // James's four seeds of two small generators, whose bits together make up the first sums.
  const int of_product = (seed - 1) / 30082, of_sum = (seed - 1) % 30082;
  int i = of_product / 177 % 177 + 2, j = of_product % 177 + 2;
  int k = of_sum / 169 % 178 + 1, l = of_sum % 169;
  for (auto sum = recent_.rbegin(); sum != recent_.rend(); ++sum)
    for (int bit = 0; bit < 24; ++bit) {
      const int product = i * j % 179 * k % 179;
      i = j;
      j = k;
      k = product;
      l = (53 * l + 1) % 169;
      *sum = 2 * *sum + (l * product % 64 >= 32 ? 1 : 0);
    }
  const std::int32_t first =
      (recent_[0] - recent_[detail::kRanmarLongLag - detail::kRanmarShortLag]) & detail::kRanmarMask;
  std::rotate(recent_.begin(), recent_.begin() + 1, recent_.end());
  recent_.back() = first;
}

void RanmarNoise::draw(Span<Vec3> noise) {
  if (noise.empty()) return;
  detail::force_kernels(instruction_set())
      .noise.ranmar({recent_.data(), &shift_, 3 * noise.size(), &noise[0].x});
}

void add_langevin_forces(Span<const double> drag, Span<const double> strength, Span<const Vec3> velocities,
                         Span<const Vec3> noise, Span<Vec3> forces) {
  detail::require_same_count(forces.size(), "forces", drag.size(), "numbers for drag");
  detail::require_same_count(forces.size(), "forces", strength.size(), "strengths of noise");
  detail::require_same_count(forces.size(), "forces", velocities.size(), "velocities");
  detail::require_same_count(forces.size(), "forces", noise.size(), "vectors of noise");
  if (forces.empty()) return;
  detail::force_kernels(instruction_set())
      .noise.langevin(
          {drag.data(), strength.data(), velocities.data(), noise.data(), forces.data(), forces.size()});
}

}  // namespace dch

// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include <dch/necklace/contacts.hpp>

namespace dch::necklace::detail {

/// The contact of particle i with radius a at `at` and particle j with radius b at `at` + d, i < j.
inline Contact contact_of(std::int32_t i, std::int32_t j, Vec3 at, Vec3 d, double a, double b) {
  const double distance = std::sqrt(norm2(d));
  const Vec3 toward = distance > 0 ? (1 / distance) * d : Vec3{1, 0, 0};  // any, if the centers coincide
  return {i, j, distance - a - b, at + a * toward, at + d - b * toward};
}

}  // namespace dch::necklace::detail

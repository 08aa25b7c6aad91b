// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/necklace/contacts.hpp>

#include "contacts/found_pairs.hpp"

namespace dch::necklace::detail {

/// The contact of particle i with radius a at `at` and particle j with radius b at `at` + d, i < j.
inline Contact contact_of(std::int32_t i, std::int32_t j, Vec3 at, Vec3 d, double a, double b) {
  const double distance = std::sqrt(norm2(d));
  const Vec3 toward = distance > 0 ? (1 / distance) * d : Vec3{1, 0, 0};  // any, if the centers coincide
  return {i, j, distance - a - b, at + a * toward, at + d - b * toward};
}

/// The contacts of pairs in order; contact_at(pair) makes one.
template <class ContactAt>
std::vector<Contact> contacts_of(FoundPairs& found, Executor* executor, const ContactAt& contact_at) {
  const std::vector<FoundPairs::Pair>& pairs = found.sorted(executor);
  std::vector<Contact> result(pairs.size());
  for_ranges(executor, pairs.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) result[k] = contact_at(pairs[k]);
  });
  return result;
}

}  // namespace dch::necklace::detail

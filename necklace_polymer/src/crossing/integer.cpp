// SPDX-License-Identifier: MIT
#include "crossing/integer.hpp"

#include <bit>
#include <cmath>

namespace dch::necklace::detail {
namespace {

using Limbs = std::vector<std::uint32_t>;

/// Of magnitudes: -1 if a < b, 0 if they are equal, else 1.
int compare(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t k = a.size(); k-- > 0;) {
    if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
  }
  return 0;
}

void add_to(Limbs& a, const Limbs& b) {
  if (a.size() < b.size()) a.resize(b.size());
  std::uint64_t carry = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    carry += std::uint64_t{a[k]} + (k < b.size() ? b[k] : 0);
    a[k] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  if (carry != 0) a.push_back(static_cast<std::uint32_t>(carry));
}

/// larger - smaller
Limbs difference(const Limbs& larger, const Limbs& smaller) {
  Limbs result(larger.size());
  std::int64_t borrow = 0;
  for (std::size_t k = 0; k < larger.size(); ++k) {
    const std::int64_t value = std::int64_t{larger[k]} - (k < smaller.size() ? smaller[k] : 0) + borrow;
    result[k] = static_cast<std::uint32_t>(value);
    borrow = value < 0 ? -1 : 0;
  }
  return result;
}

}  // namespace

Integer::Integer(std::int64_t value) : negative_(value < 0) {
  auto magnitude = static_cast<std::uint64_t>(value);
  if (negative_) magnitude = ~magnitude + 1;
  for (; magnitude != 0; magnitude >>= 32) limbs_.push_back(static_cast<std::uint32_t>(magnitude));
}

std::size_t Integer::bits() const {
  if (limbs_.empty()) return 0;
  return 32 * limbs_.size() - static_cast<std::size_t>(std::countl_zero(limbs_.back()));
}

double Integer::scaled(std::size_t shift) const {
  double value = 0;
  for (std::size_t k = limbs_.size(); k > 0 && k + 3 > limbs_.size(); --k) {
    value += std::ldexp(limbs_[k - 1], static_cast<int>(32 * (k - 1)) - static_cast<int>(shift));
  }
  return negative_ ? -value : value;
}

Integer Integer::operator-() const {
  Integer result = *this;
  result.negative_ = !negative_ && !limbs_.empty();
  return result;
}

Integer& Integer::add(const Integer& other, bool other_negative) {
  if (negative_ == other_negative || limbs_.empty()) {
    if (limbs_.empty()) negative_ = other_negative;
    add_to(limbs_, other.limbs_);
  } else if (compare(limbs_, other.limbs_) >= 0) {
    limbs_ = difference(limbs_, other.limbs_);
  } else {
    limbs_ = difference(other.limbs_, limbs_);
    negative_ = other_negative;
  }
  trim();
  return *this;
}

Integer& Integer::operator<<=(std::size_t bits) {
  if (limbs_.empty() || bits == 0) return *this;
  const std::size_t whole = bits / 32, part = bits % 32;
  limbs_.push_back(0);
  if (part != 0) {
    for (std::size_t k = limbs_.size(); k-- > 1;)
      limbs_[k] = (limbs_[k] << part) | (limbs_[k - 1] >> (32 - part));
    limbs_[0] <<= part;
  }
  limbs_.insert(limbs_.begin(), whole, 0);
  trim();
  return *this;
}

Integer operator*(const Integer& a, const Integer& b) {
  Integer result;
  if (a.limbs_.empty() || b.limbs_.empty()) return result;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    result.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  result.negative_ = a.negative_ != b.negative_;
  result.trim();
  return result;
}

void Integer::trim() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  if (limbs_.empty()) negative_ = false;
}

}  // namespace dch::necklace::detail

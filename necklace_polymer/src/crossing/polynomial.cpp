// SPDX-License-Identifier: MIT
#include "crossing/polynomial.hpp"

#include <algorithm>
#include <utility>

namespace dch::necklace::detail {
namespace {

/// low + (high - low) * part / 8
Dyadic between(const RootInterval& interval, int part) {
  const std::size_t exponent = std::max(interval.low.exponent, interval.high.exponent);
  const Integer low = interval.low.numerator << (exponent - interval.low.exponent);
  const Integer high = interval.high.numerator << (exponent - interval.high.exponent);
  return {low * Integer(8 - part) + high * Integer(part), exponent + 3};
}

/// A point within the interval where p is not 0. A cubic has three roots, and there are four points.
Dyadic split_point(const Polynomial& p, const RootInterval& interval) {
  for (const int part : {4, 3, 5}) {
    Dyadic t = between(interval, part);
    if (p.sign_at(t) != 0) return t;
  }
  return between(interval, 2);
}

}  // namespace

double Dyadic::value() const { return numerator.scaled(exponent); }

Polynomial::Polynomial(std::vector<Integer> coefficients) : c_(std::move(coefficients)) { trim(); }

Integer Polynomial::value_at(const Dyadic& t, int degree) const {
  Integer value;
  for (int k = this->degree(); k >= 0; --k) {
    value = value * t.numerator +
            (c_[static_cast<std::size_t>(k)] << (t.exponent * static_cast<std::size_t>(degree - k)));
  }
  return value;
}

Polynomial Polynomial::derivative() const {
  std::vector<Integer> result;
  for (std::size_t k = 1; k < c_.size(); ++k) {
    result.push_back(c_[k] * Integer(static_cast<std::int64_t>(k)));
  }
  return Polynomial(std::move(result));
}

Polynomial Polynomial::negative() const {
  Polynomial result = *this;
  for (Integer& c : result.c_) c = -c;
  return result;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> result(std::max(a.c_.size(), b.c_.size()));
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (k < a.c_.size()) result[k] += a.c_[k];
    if (k < b.c_.size()) result[k] += b.c_[k];
  }
  return Polynomial(std::move(result));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<Integer> result(a.c_.size() + b.c_.size() - 1);
  for (std::size_t i = 0; i < a.c_.size(); ++i) {
    for (std::size_t j = 0; j < b.c_.size(); ++j) result[i + j] += a.c_[i] * b.c_[j];
  }
  return Polynomial(std::move(result));
}

Polynomial remainder(Polynomial a, const Polynomial& b) {
  const bool is_negative = b.leading().sign() < 0;
  const Integer factor = is_negative ? -b.leading() : b.leading();  // > 0, so that signs stay
  while (a.degree() >= b.degree()) {
    const auto shift = static_cast<std::size_t>(a.degree() - b.degree());
    const Integer by = is_negative ? -a.leading() : a.leading();
    for (Integer& c : a.c_) c = c * factor;
    for (std::size_t k = 0; k < b.c_.size(); ++k) a.c_[k + shift] -= by * b.c_[k];
    a.trim();
  }
  return a;
}

void Polynomial::trim() {
  while (!c_.empty() && c_.back().sign() == 0) c_.pop_back();
}

TarskiQuery::TarskiQuery(const Polynomial& p, const Polynomial& g) {
  sequence_.push_back(p);
  for (Polynomial next = p.derivative() * g; !next.is_zero();) {
    sequence_.push_back(next);
    next = remainder(sequence_[sequence_.size() - 2], sequence_.back()).negative();
  }
}

int TarskiQuery::variations(const Dyadic& t) const {
  int count = 0, last = 0;
  for (const Polynomial& p : sequence_) {
    const int sign = p.sign_at(t);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

std::vector<RootInterval> isolate_roots(const Polynomial& p, const TarskiQuery& count) {
  std::vector<RootInterval> found, open{{{Integer(0), 0}, {Integer(1), 0}}};
  while (!open.empty()) {
    RootInterval interval = std::move(open.back());
    open.pop_back();
    const int roots = count.between(interval.low, interval.high);
    if (roots == 0) continue;
    if (roots == 1) {
      found.push_back(std::move(interval));
      continue;
    }
    const Dyadic middle = split_point(p, interval);
    open.push_back({middle, interval.high});
    open.push_back({interval.low, middle});
  }
  return found;
}

void narrow(const Polynomial& p, RootInterval& root, std::size_t bits) {
  const int high = p.sign_at(root.high);
  for (;;) {
    const std::size_t exponent = std::max(root.low.exponent, root.high.exponent);
    const Integer gap = (root.high.numerator << (exponent - root.high.exponent)) -
                        (root.low.numerator << (exponent - root.low.exponent));
    if (gap.bits() + bits <= exponent) return;
    Dyadic middle = split_point(p, root);
    (p.sign_at(middle) == high ? root.high : root.low) = std::move(middle);
  }
}

}  // namespace dch::necklace::detail

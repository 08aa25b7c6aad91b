// SPDX-License-Identifier: MIT
//
// What the driver writes into the sources in the place of operators and around clauses and statements. All
// mutants of a file are compiled at once; the one whose number DCH_MUTANT gives is at work.
#pragma once

#include <cstdlib>

namespace mutants {

/// Set before main().
extern int active;

inline bool is(int number) { return active == number; }

/// `a < Relation<'<', 7>() > b` is a < b: a name for an operator that has the precedence of the one in its
/// place.
template <char kRelation, int kNumber>
struct Relation {};
template <char kRelation, int kNumber, class A>
struct Compared {
  const A& a;
};

template <class A, char kRelation, int kNumber>
Compared<kRelation, kNumber, A> operator<(const A& a, Relation<kRelation, kNumber>) {
  return {a};
}
template <class A, char kRelation, int kNumber>
Compared<kRelation, kNumber, A> operator==(const A& a, Relation<kRelation, kNumber>) {
  return {a};
}

/// Of each operator the first mutant is its neighbor and the second its negation; of (in)equality only the
/// latter.
template <char kRelation, int kNumber, class A, class B>
bool related(const A& a, const B& b) {
  const int variant = active - kNumber;
  if constexpr (kRelation == '<') return variant == 0 ? a <= b : variant == 1 ? a >= b : a < b;
  if constexpr (kRelation == 'l') return variant == 0 ? a < b : variant == 1 ? a > b : a <= b;
  if constexpr (kRelation == '>') return variant == 0 ? a >= b : variant == 1 ? a <= b : a > b;
  if constexpr (kRelation == 'g') return variant == 0 ? a > b : variant == 1 ? a < b : a >= b;
  if constexpr (kRelation == '=') return variant == 0 ? a != b : a == b;
  if constexpr (kRelation == '!') return variant == 0 ? a == b : a != b;
}
template <char kRelation, int kNumber, class A, class B>
bool operator>(Compared<kRelation, kNumber, A> left, const B& b) {
  return related<kRelation, kNumber>(left.a, b);
}
template <char kRelation, int kNumber, class A, class B>
bool operator==(Compared<kRelation, kNumber, A> left, const B& b) {
  return related<kRelation, kNumber>(left.a, b);
}

/// `a + Sum<'-', 7>() + b` is a - b.
template <char kSign, int kNumber>
struct Sum {};
template <char kSign, int kNumber, class A>
struct Summed {
  const A& a;
};
template <class A, char kSign, int kNumber>
Summed<kSign, kNumber, A> operator+(const A& a, Sum<kSign, kNumber>) {
  return {a};
}
template <char kSign, int kNumber, class A, class B>
auto operator+(Summed<kSign, kNumber, A> left, const B& b) {
  if constexpr (kSign == '+') {
    return is(kNumber) ? left.a - b : left.a + b;
  } else {
    return is(kNumber) ? left.a + b : left.a - b;
  }
}

template <int kNumber, bool kLargest, class T>
T extreme(const T& a, const T& b) {
  return (a < b) == (kLargest != is(kNumber)) ? b : a;
}

}  // namespace mutants

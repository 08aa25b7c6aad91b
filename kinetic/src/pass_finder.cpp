// SPDX-License-Identifier: MIT
#include "pass_finder.hpp"

#include <algorithm>
#include <cmath>

namespace dch::kinetic {
namespace {

ListParams within(double cutoff) {
  ListParams params;
  params.cutoffs = TypeCutoffs(cutoff);
  return params;
}

}  // namespace

PassFinder::PassFinder(double cutoff, double error, Span<const Vec3> before, const Box& box_before,
                       Span<const Vec3> after, const Box& box_after)
    : params_(within(cutoff)),
      cutoff2_(cutoff * cutoff),
      in_below_(std::pow(std::max(0.0, cutoff - error), 2)),
      out_above_(std::pow(cutoff + error, 2)),
      before_(before, box_before, params_, error),
      after_(after, box_after, params_, error) {}

/// |d + v s|^2 = R^2 for s = t - 1/2 has the discriminant v^2 R^2 - |d x v|^2, which cancels nothing far
/// away.
std::optional<PassingContact> PassFinder::closed_form(std::int32_t i, std::int32_t j, Vec3 d, Vec3 v,
                                                      double before2, double after2) const {
  PassingContact contact;
  contact.i = std::min(i, j);
  contact.j = std::max(i, j);
  contact.is_shown_before = is_shown(before2, before_, i, j);
  contact.is_shown_after = is_shown(after2, after_, i, j);
  const double a = norm2(v), b = dot(d, v), off2 = norm2(cross(d, v));
  const double discriminant = a * cutoff2_ - off2;
  const bool turns = 2 * std::abs(b) < a;  // the least distance lies between the frames
  if (contact.is_hidden() && !(turns && discriminant > 0)) return std::nullopt;
  contact.closest = turns ? std::sqrt(off2 / a) : std::sqrt(std::min(before2, after2));
  if (!(a > 0)) return contact;
  // Where rounding leaves no root, the pair is at its distance where it is nearest.
  const double root = std::sqrt(std::max(0.0, discriminant)), c = norm2(d) - cutoff2_;
  const double q = b < 0 ? root - b : -(b + root);  // of both the one that adds; the other root is c over it
  double enters = q / a, leaves = q != 0 ? c / q : 0;
  if (b < 0) std::swap(enters, leaves);
  if (discriminant <= 0) enters = leaves = -b / a;
  if (!contact.is_shown_before) contact.enters = std::clamp(0.5 + enters, 0.0, 1.0);
  if (!contact.is_shown_after) contact.leaves = std::clamp(0.5 + leaves, contact.enters, 1.0);
  return contact;
}

}  // namespace dch::kinetic

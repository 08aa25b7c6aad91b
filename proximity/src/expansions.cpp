// SPDX-License-Identifier: MIT
#include "expansions.hpp"

#include <algorithm>

namespace dch::detail {
namespace {

int exponent(MultiIndex index, int axis) { return axis == 0 ? index.a : axis == 1 ? index.b : index.c; }

MultiIndex lowered(MultiIndex index, int axis, int by) {
  (axis == 0 ? index.a : axis == 1 ? index.b : index.c) -= by;
  return index;
}

/// The two others that a second derivative along z stands for.
std::array<MultiIndex, 2> others_of(MultiIndex i) {
  return {MultiIndex{i.a + 2, i.b, i.c - 2}, MultiIndex{i.a, i.b + 2, i.c - 2}};
}

}  // namespace

Expansions::Expansions(int order, bool is_harmonic)
    : order_(order), is_harmonic_(is_harmonic), whole_(order, order), short_(order, is_harmonic ? 1 : order) {
  for (const MultiIndex index : short_.all()) place_in_whole_.push_back(whole_.place(index));
  for (int degree = 0; degree <= order; ++degree) degree_end_.push_back(short_.up_to(degree));
  for (int i = 0; i < whole_.size(); ++i)
    for (int j = 0; j < whole_.up_to(order - whole_[i].degree()); ++j)
      translation_.push_back({whole_.place(whole_[i] + whole_[j]), i, j});
  list_steps();
}

// The recursion of McMurchie and Davidson (J. Comput. Phys. 26:218, 1978): with G_m = (1/r d/dr)^m K and D_i
// the derivatives of it, those of D_(i + x) of G_m are x D_i + i_x D_(i - x) of G_(m+1), as x G_(m+1) is the
// derivative of G_m along x.
void Expansions::list_steps() {
  // The order of the workspace: radial derivatives, all derivatives of G_0, traces, and twice the room for
  // those of another G, since those of G_m take no others than those of G_(m+1).
  const MultiIndices& derived = short_;
  const MultiIndices needed(order_, is_harmonic_ ? 2 : order_);
  const int radials = order_ + 1, room = derived.size(), behind = radials + needed.size();
  const auto place = [&](MultiIndex index, int m) {
    if (index.degree() == 0) return m;
    return derived.place(index) + (m == 0 ? radials : behind + m % 2 * room);
  };
  for (int m = order_ - 1; m >= 0; --m) {
    for (int k = 1; k < derived.up_to(order_ - m); ++k) {
      const MultiIndex index = derived[k];
      const int axis = index.c > 0 ? 2 : index.b > 0 ? 1 : 0, rest = exponent(index, axis) - 1;
      const int minus_one = place(lowered(index, axis, 1), m + 1);
      const int minus_two = rest > 0 ? place(lowered(index, axis, 2), m + 1) : minus_one;
      steps_.push_back({place(index, m), minus_one, minus_two, axis, static_cast<double>(rest)});
    }
  }
  // With z^1 in both expansions, derivatives by z^2 are needed as well.
  int next = radials + derived.size();
  std::vector<int> place_of;
  for (const MultiIndex index : needed.all()) {
    const bool is_trace = is_harmonic_ && index.c == 2;
    place_of.push_back(is_trace ? next++ : place(index, 0));
    if (!is_trace) continue;
    traces_.push_back(place_of.back());
    for (const MultiIndex other : others_of(index)) traces_.push_back(place(other, 0));
  }
  for (const MultiIndex local : short_.all())
    for (int j = 0; j < short_.up_to(order_ - local.degree()); ++j)
      derivative_.push_back(
          static_cast<std::uint16_t>(place_of[static_cast<std::size_t>(needed.place(local + short_[j]))]));
  const int rows = padded(short_.size()) + behind + 2 * room;
  work_size_ = static_cast<std::size_t>(rows) * kSumLanes;
}

TranslationTables Expansions::tables() const {
  return {order_,
          static_cast<std::int32_t>(short_.size()),
          static_cast<std::int32_t>(steps_.size()),
          static_cast<std::int32_t>(traces_.size() / 3),
          steps_.data(),
          traces_.data(),
          degree_end_.data(),
          derivative_.data()};
}

void Expansions::set_monomials(Vec3 v, Monomials& monomials) const {
  std::array<std::array<double, kMaxOrder + 1>, 3> powers;
  for (int axis = 0; axis < 3; ++axis) {
    auto& power = powers[static_cast<std::size_t>(axis)];
    power[0] = 1;
    for (std::size_t k = 1; k <= static_cast<std::size_t>(order_); ++k)
      power[k] = power[k - 1] * v[axis] / static_cast<double>(k);
  }
  std::size_t k = 0;
  for (const MultiIndex i : whole_.all())
    monomials[k++] = powers[0][static_cast<std::size_t>(i.a)] * powers[1][static_cast<std::size_t>(i.b)] *
                     powers[2][static_cast<std::size_t>(i.c)];
}

void Expansions::add_charge(double charge, Vec3 from_center, double* moments) const {
  Monomials of;
  set_monomials(-1.0 * from_center, of);
  for (std::size_t k = 0; k < size(); ++k) moments[k] += charge * of[k];
}

void Expansions::scale_degrees(double size, double* expansion) const {
  double scale = size;
  for (int degree = 1; degree <= order_; ++degree, scale *= size)
    for (int k = whole_.up_to(degree - 1); k < whole_.up_to(degree); ++k) expansion[k] *= scale;
}

void Expansions::add_child(const double* child, Vec3 to_center, double size, double* moments) const {
  Monomials of, scaled;
  set_monomials(to_center, of);
  std::copy_n(child, whole_.size(), scaled.begin());
  scale_degrees(size, scaled.data());
  for (const auto& [both, i, j] : translation_)
    moments[both] += scaled[static_cast<std::size_t>(i)] * of[static_cast<std::size_t>(j)];
}

void Expansions::shorten(const double* moments, double* short_moments) const {
  std::vector<double> folded(moments, moments + whole_.size());
  for (int c = order_; is_harmonic_ && c >= 2; --c)
    for (int k = 0; k < whole_.size(); ++k) {
      if (whole_[k].c != c) continue;
      for (const MultiIndex other : others_of(whole_[k]))
        folded[static_cast<std::size_t>(whole_.place(other))] -= folded[static_cast<std::size_t>(k)];
    }
  for (int k = 0; k < short_.size(); ++k)
    short_moments[k] = folded[static_cast<std::size_t>(place_in_whole_[static_cast<std::size_t>(k)])];
}

void Expansions::add_whole(const double* short_local, double* local) const {
  std::vector<double> unfolded(size(), 0.0);
  for (int k = 0; k < short_.size(); ++k)
    unfolded[static_cast<std::size_t>(place_in_whole_[static_cast<std::size_t>(k)])] = short_local[k];
  for (int c = 2; is_harmonic_ && c <= order_; ++c)
    for (int k = 0; k < whole_.size(); ++k) {
      if (whole_[k].c != c) continue;
      for (const MultiIndex other : others_of(whole_[k]))
        unfolded[static_cast<std::size_t>(k)] -= unfolded[static_cast<std::size_t>(whole_.place(other))];
    }
  for (std::size_t k = 0; k < unfolded.size(); ++k) local[k] += unfolded[k];
}

void Expansions::to_child(const double* local, Vec3 from_center, double size, double* child) const {
  Monomials of;
  set_monomials(from_center, of);
  std::fill_n(child, whole_.size(), 0.0);
  for (const auto& [both, i, j] : translation_) child[i] += local[both] * of[static_cast<std::size_t>(j)];
  scale_degrees(size, child);
}

double Expansions::potential(const double* local, Vec3 from_center) const {
  Monomials of;
  set_monomials(from_center, of);
  double sum = 0;
  for (std::size_t k = 0; k < size(); ++k) sum += local[k] * of[k];
  return sum;
}

}  // namespace dch::detail

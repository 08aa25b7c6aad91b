// SPDX-License-Identifier: MIT
#include "question.hpp"

#include <algorithm>

#include "descent.hpp"
#include "kink_search.hpp"
#include "predicates.hpp"

namespace dch::zonotope {
namespace {

double largest(Vec3 v) {
  const Vec3 m = magnitudes(v);
  return std::max({m.x, m.y, m.z});
}

std::vector<ExactVec> exact_generators(const Question& question) {
  std::vector<ExactVec> result;
  result.reserve(question.generators.size());
  for (const Vec3& u : question.generators) result.push_back(exact(u));
  return result;
}

bool is_zero(const ExactVec& v) { return v.x.sign() == 0 && v.y.sign() == 0 && v.z.sign() == 0; }

Exact magnitude(const Exact& x) { return x.sign() < 0 ? -x : x; }

Reach reach_along(const std::vector<ExactVec>& generators, const ExactVec& point, const ExactVec& normal) {
  Reach reach{{}, magnitude(dot(normal, point))};
  for (const ExactVec& u : generators) reach.support = reach.support + magnitude(dot(normal, u));
  return reach;
}

/// All generators are in a plane through the point, on its line or not. Along a line of normals in that
/// plane, from n = point on, the weighted median of the kinks is the edge that the ray meets.
Reach flat_reach(const std::vector<ExactVec>& generators, const ExactVec& point) {
  const auto aside = std::find_if(generators.begin(), generators.end(),
                                  [&](const ExactVec& u) { return !is_zero(cross(point, u)); });
  if (aside == generators.end()) return reach_along(generators, point, point);
  const ExactVec up = cross(point, *aside), along = cross(up, point);
  struct Kink {
    Exact where, weight;  // the kink is at where / weight
    std::size_t generator;
  };
  std::vector<Kink> kinks;
  Exact slope;
  for (std::size_t k = 0; k < generators.size(); ++k) {
    Exact weight = dot(along, generators[k]), where = -dot(point, generators[k]);
    if (weight.sign() == 0) continue;
    if (weight.sign() < 0) weight = -weight, where = -where;
    slope = slope - weight;
    kinks.push_back({where, weight, k});
  }
  std::sort(kinks.begin(), kinks.end(), [](const Kink& a, const Kink& b) {
    return (a.where * b.weight - b.where * a.weight).sign() < 0;
  });
  for (const Kink& kink : kinks) {
    slope = slope + kink.weight + kink.weight;
    if (slope.sign() >= 0) return reach_along(generators, point, cross(up, generators[kink.generator]));
  }
  return {};  // not reached: a generator beside the point's line has a kink, and the last slope is positive
}

/// A second generator whose plane with a first one the point is not in.
bool find_plane(const std::vector<ExactVec>& generators, const ExactVec& point, std::size_t& i,
                std::size_t& j) {
  const auto is_plane = [&] { return dot(cross(generators[i], generators[j]), point).sign() != 0; };
  if (i < generators.size() && j < generators.size() && is_plane()) return true;
  for (i = 0; i < generators.size() && is_zero(cross(generators[i], point));) ++i;
  if (i == generators.size()) return false;
  for (j = 0; j < generators.size(); ++j)
    if (is_plane()) return true;
  return false;
}

}  // namespace

bool is_separated(const Question& question, Vec3 normal) {
  double reach = 0;
  Vec3 sizes = magnitudes(question.point) + magnitudes(question.tail);
  for (const Vec3& u : question.generators) {
    reach += std::abs(dch::dot(normal, u));
    sizes = sizes + magnitudes(u);
  }
  const double bound = (static_cast<double>(question.generators.size()) + 16) * 2 * kRounding *
                       dch::dot(magnitudes(normal), sizes);
  const double height = std::abs(dch::dot(normal, question.point));
  return height - reach > bound + dch::dot(magnitudes(normal), magnitudes(question.tail)) + kSmallest;
}

bool is_inside(const Question& question, Vec3 normal, std::size_t i, std::size_t j) {
  const std::vector<Vec3>& u = question.generators;
  const double height = dch::dot(normal, question.point);
  double reach = 0, best = 0;
  std::size_t third = SIZE_MAX;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double w = std::abs(dch::dot(normal, u[k]));
    reach += w;
    if (k != i && k != j && w > best) best = w, third = k;
  }
  if (third == SIZE_MAX || !(height <= reach)) return false;
  const double share = reach > 0 ? std::max(0.0, height / reach) : 0;
  Vec3 rest = question.point, sizes = magnitudes(question.point);
  const auto take = [&](double coefficient, Vec3 v) {
    rest = rest - coefficient * v;
    sizes = sizes + std::abs(coefficient) * magnitudes(v);
  };
  for (std::size_t k = 0; k < u.size(); ++k)
    if (k != i && k != j && k != third) take(sign_of(dch::dot(normal, u[k])) * share, u[k]);
  // The rest by three generators: Cramer's rule, then once more for what rounding left.
  const Vec3 rows[3] = {dch::cross(u[j], u[third]), dch::cross(u[third], u[i]), dch::cross(u[i], u[j])};
  const Vec3 basis[3] = {u[i], u[j], u[third]};
  const double det = dch::dot(rows[0], u[i]), permanent = dch::dot(magnitudes(rows[0]), magnitudes(u[i]));
  if (!(std::abs(det) > 1e-7 * permanent && std::abs(det) > kSmallest)) return false;
  double coefficients[3] = {};
  for (int k = 0; k < 3; ++k) coefficients[k] = dch::dot(rows[k], rest) / det;
  for (int k = 0; k < 3; ++k) take(coefficients[k], basis[k]);
  const double roundings = (static_cast<double>(u.size()) + 16) * 2 * kRounding;
  const Vec3 unsure = magnitudes(rest) + magnitudes(question.tail) + roundings * sizes;
  for (int k = 0; k < 3; ++k) {
    const double error = 2 * dch::dot(magnitudes(rows[k]), unsure) / std::abs(det);
    if (!(std::abs(coefficients[k]) + error <= 1 - 4 * kRounding)) return false;
  }
  return true;
}

Reach exact_reach(const Question& question, std::size_t i, std::size_t j) {
  const std::vector<ExactVec> generators = exact_generators(question);
  const ExactVec point = question.exact_point();
  if (is_zero(point)) return {};
  if (!find_plane(generators, point, i, j)) return flat_reach(generators, point);
  Descent<Exact> descent(generators, point);
  descent.start(i, j);
  while (descent.step()) {
  }
  return {descent.support(), descent.height()};
}

MetFacet facet_towards(const Question& question) {
  MetFacet facet;
  const std::vector<Vec3>& u = question.generators;
  const double size = std::sqrt(norm2(question.point));
  if (!(size > 1e-140) || u.empty()) return facet;
  const Vec3 ray = 1 / size * question.point;
  // Two vectors that complete the ray to an orthonormal basis (J. Duff et al., J. Comput. Graph. Tech. 6:1,
  // 2017).
  const double sign = std::copysign(1.0, ray.z), p = -1 / (sign + ray.z), r = ray.x * ray.y * p;
  const Vec3 first{1 + sign * ray.x * ray.x * p, sign * r, -sign * ray.x};
  const Vec3 second{r, sign + ray.y * ray.y * p, -ray.y};
  double scale = 0;
  for (const Vec3& v : u) scale = std::max(scale, largest(v));
  std::vector<KinkLine> lines;
  std::vector<Vec<double>> rounded_generators;
  for (const Vec3& v : u) {
    rounded_generators.push_back(rounded(1 / scale * v));
    const Vec3 w = vec3(rounded_generators.back());
    lines.push_back({dch::dot(first, w), dch::dot(second, w), dch::dot(ray, w)});
  }
  const KinkMinimum least = least_kinks(lines);
  facet.rounds = least.rounds;
  facet.operations = least.operations;
  // From about there to the very facet: rounding may have led to one beside it.
  Descent<double> descent(rounded_generators, rounded(ray));
  descent.start(rounded(ray + least.x * first + least.y * second), least.line);
  constexpr int kSteps = 8;
  double value = descent.support() / descent.height();
  for (int step = 0; step < kSteps && descent.step(); ++step) {
    facet.operations += static_cast<std::int64_t>(3 * u.size());
    const double now = descent.support() / descent.height();
    const bool falls = now < value;
    value = std::min(value, now);
    if (!falls && step > 1) break;
  }
  facet.normal = vec3(descent.normal());
  facet.i = descent.i();
  facet.j = descent.j();
  facet.support = scale * descent.support();
  facet.height = size * descent.height();
  if (facet.i == facet.j) {  // it stood on the vertex at once: another line through it
    double best = INFINITY;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const Vec3 across = dch::cross(vec3(rounded_generators[facet.i]), vec3(rounded_generators[k]));
      const double weight = std::abs(dch::dot(across, ray)), w = std::abs(descent.products()[k]);
      if (weight > 1e-12 && w < best * weight) best = w / weight, facet.j = k;
    }
  }
  return facet;
}

}  // namespace dch::zonotope

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/embedded_atoms.hpp>

#include "base/describe.hpp"
#include "same_count.hpp"
#include "simd/embedded_kernels.hpp"

namespace dch {
namespace {

using detail::Cubic;
using detail::EmbeddedLine;
using detail::PointAndNumber;

constexpr std::size_t kFewestValues = 5;

double cubic_at(const Cubic& f, double p) { return f.a + p * (f.b + p * (f.c + p * f.d)); }
double cubic_slope(const Cubic& f, double p) { return f.b + p * (2 * f.c + p * 3 * f.d); }

/// Pieces from each knot to the next one, of the last one those that stay there.
std::vector<Cubic> cubics_between(const std::vector<double>& f) {
  const std::size_t n = f.size();
  std::vector<double> slope(n);
  slope[0] = f[1] - f[0];
  slope[1] = 0.5 * (f[2] - f[0]);
  slope[n - 2] = 0.5 * (f[n - 1] - f[n - 3]);
  slope[n - 1] = f[n - 1] - f[n - 2];
  for (std::size_t k = 2; k + 2 < n; ++k) slope[k] = ((f[k - 2] - f[k + 2]) + 8 * (f[k + 1] - f[k - 1])) / 12;
  std::vector<Cubic> pieces(n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double rise = f[k + 1] - f[k];
    pieces[k] = {f[k], slope[k], 3 * rise - 2 * slope[k] - slope[k + 1], slope[k] + slope[k + 1] - 2 * rise};
  }
  pieces[n - 1] = {f[n - 1], slope[n - 1], 0, 0};
  return pieces;
}

void require(bool holds, const std::string& what) {
  if (!holds) throw InvalidParameter("embedded atoms: " + what);
}

void require_positive(double value, const char* name) {
  require(std::isfinite(value) && value > 0,
          std::string(name) + " is " + detail::describe(value) + "; it must be finite and above 0");
}

void require_functions(const std::vector<std::vector<double>>& given, std::size_t count, const char* name) {
  require(given.size() == count, std::to_string(given.size()) + " functions given as " + name + ", not " +
                                     std::to_string(count) + " as types ask for");
  for (const auto& values : given)
    require(values.size() == given[0].size() && values.size() >= kFewestValues,
            std::to_string(values.size()) + " values in one of " + name +
                "; give as many in each, at least " + std::to_string(kFewestValues));
}

bool are_alike(const EmbeddedAtomParams& params) {
  const auto all_equal = [](const std::vector<std::vector<double>>& given) {
    return std::all_of(given.begin(), given.end(), [&](const auto& values) { return values == given[0]; });
  };
  return all_equal(params.densities) && all_equal(params.pairs);
}

}  // namespace

struct EmbeddedAtoms::Impl {
  int types = 1;
  std::size_t kinds = 1;  ///< of atoms whose functions of distances differ
  double cutoff = 0, knots_per_length = 0, knots_per_density = 0, line_from = 0;
  std::size_t knots = 0, embedding_knots = 0;
  std::vector<EmbeddedLine> lines;
  std::vector<Cubic> embeddings;
  std::vector<PointAndNumber> points, forces;
  std::vector<std::int32_t> near, near_counts;

  explicit Impl(const EmbeddedAtomParams& params)
      : types(params.types),
        kinds(are_alike(params) ? 1 : static_cast<std::size_t>(params.types)),
        cutoff(params.cutoff),
        knots_per_length(1 / params.distance_step),
        knots_per_density(1 / params.density_step),
        line_from(params.line_from > 0
                      ? params.line_from
                      : static_cast<double>(params.embeddings[0].size() - 1) * params.density_step),
        knots(params.densities[0].size()),
        embedding_knots(params.embeddings[0].size()) {
    lines.reserve(kinds * kinds * knots);
    for (std::size_t a = 0; a < kinds; ++a)
      for (std::size_t b = 0; b < kinds; ++b) {
        const std::size_t at = a * static_cast<std::size_t>(types) + b;
        const auto densities = cubics_between(params.densities[at]), pairs = cubics_between(params.pairs[at]);
        for (std::size_t k = 0; k < knots; ++k) lines.push_back({densities[k], pairs[k]});
      }
    for (const auto& values : params.embeddings) {
      const auto pieces = cubics_between(values);
      embeddings.insert(embeddings.end(), pieces.begin(), pieces.end());
    }
  }

  detail::EmbeddedTask task(const NeighborRows& rows, Span<const std::int32_t> of_types) {
    detail::EmbeddedTask all{};
    all.atoms = rows.atoms.data();
    all.rows = static_cast<std::int64_t>(rows.atoms.size());
    all.counts = rows.counts;
    all.neighbors = rows.neighbors;
    all.number_bits = rows.number_bits;
    all.points = points.data();
    all.type = of_types.data();
    all.types = static_cast<std::int32_t>(kinds);
    all.lines = lines.data();
    all.last_knot = static_cast<double>(knots - 1);
    all.knots_per_length = knots_per_length;
    all.cutoff2 = cutoff * cutoff;
    all.near = near.data();
    all.near_counts = near_counts.data();
    all.forces = forces.data();
    return all;
  }

  /// The line of a distance, and what part of the way to the next one there is.
  const EmbeddedLine& line(std::size_t first, std::size_t second, double distance, double& part) const {
    const double along = std::min(distance * knots_per_length, static_cast<double>(knots - 1));
    const double knot = std::floor(along);
    part = along - knot;
    const std::size_t a = kinds == 1 ? 0 : first, b = kinds == 1 ? 0 : second;
    return lines[(a * kinds + b) * knots + static_cast<std::size_t>(knot)];
  }
};

EmbeddedAtoms::EmbeddedAtoms(const EmbeddedAtomParams& params) {
  require(params.types >= 1, std::to_string(params.types) + " types; give at least one");
  require_positive(params.cutoff, "cutoff");
  require_positive(params.distance_step, "distance_step");
  require_positive(params.density_step, "density_step");
  const auto types = static_cast<std::size_t>(params.types);
  require_functions(params.densities, types * types, "densities");
  require_functions(params.pairs, types * types, "pairs");
  require_functions(params.embeddings, types, "embeddings");
  require(params.densities[0].size() == params.pairs[0].size(),
          std::to_string(params.pairs[0].size()) + " values in pairs, " +
              std::to_string(params.densities[0].size()) + " in densities; give as many");
  impl_ = std::make_unique<Impl>(params);
}

EmbeddedAtoms::~EmbeddedAtoms() = default;
EmbeddedAtoms::EmbeddedAtoms(EmbeddedAtoms&&) noexcept = default;
EmbeddedAtoms& EmbeddedAtoms::operator=(EmbeddedAtoms&&) noexcept = default;

void EmbeddedAtoms::add_densities(const NeighborRows& rows, Span<const Vec3> positions,
                                  Span<const std::int32_t> types, Span<double> densities) {
  const std::size_t count = positions.size();
  detail::require_same_count(count, "positions", types.size(), "types");
  detail::require_same_count(count, "positions", densities.size(), "densities");
  Impl& own = *impl_;
  own.points.resize(count);
  for (std::size_t k = 0; k < count; ++k) own.points[k] = {positions[k].x, positions[k].y, positions[k].z, 0};
  own.near_counts.assign(count, 0);
  std::size_t listed = 0;
  for (const std::int32_t atom : rows.atoms) listed += static_cast<std::size_t>(rows.counts[atom]);
  if (own.near.size() < listed + detail::kBeyondNear)
    own.near.resize(listed + listed / 8 + detail::kBeyondNear);
  detail::EmbeddedTask task = own.task(rows, types);
  task.densities = densities.data();
  detail::embedded_kernels(instruction_set()).densities(task);
}

EmbeddedAtoms::Embedding EmbeddedAtoms::embedding(int type, double density) const {
  const Impl& own = *impl_;
  const double along = density * own.knots_per_density;
  const double last = static_cast<double>(own.embedding_knots - 2);
  const double knot = std::max(0.0, std::min(std::floor(along), last)), part = std::min(along - knot, 1.0);
  const Cubic& piece = own.embeddings[static_cast<std::size_t>(type - 1) * own.embedding_knots +
                                      static_cast<std::size_t>(knot)];
  Embedding found{cubic_at(piece, part), cubic_slope(piece, part) * own.knots_per_density};
  if (density > own.line_from) found.energy += found.slope * (density - own.line_from);
  return found;
}

double EmbeddedAtoms::add_forces(const NeighborRows& rows, Span<const std::int32_t> types,
                                 Span<const double> slopes, Span<Vec3> forces, const PairVisitor& visit) {
  Impl& own = *impl_;
  const std::size_t count = own.points.size();
  detail::require_same_count(count, "positions", types.size(), "types");
  detail::require_same_count(count, "positions", slopes.size(), "slopes");
  detail::require_same_count(count, "positions", forces.size(), "forces");
  for (std::size_t k = 0; k < count; ++k) own.points[k].number = slopes[k];
  own.forces.assign(count, PointAndNumber{});
  detail::EmbeddedTask task = own.task(rows, types);
  if (visit) {
    task.visitor = &visit;
    task.visit = [](const void* visitor, const EmbeddedPair* pairs, std::int32_t found) {
      (*static_cast<const PairVisitor*>(visitor))({pairs, static_cast<std::size_t>(found)});
    };
  }
  detail::embedded_kernels(instruction_set()).forces(task);
  for (std::size_t k = 0; k < count; ++k) {
    const PointAndNumber& added = own.forces[k];
    forces[k] = forces[k] + Vec3{added.x, added.y, added.z};
  }
  return task.energy;
}

std::int32_t EmbeddedAtoms::pairs_of(std::int32_t atom) const {
  return impl_->near_counts[static_cast<std::size_t>(atom)];
}

EmbeddedAtoms::OfPair EmbeddedAtoms::of_pair(int first, int second, double distance) const {
  const Impl& own = *impl_;
  const auto a = static_cast<std::size_t>(first - 1), b = static_cast<std::size_t>(second - 1);
  double part = 0;
  const EmbeddedLine &of_first = own.line(a, b, distance, part), &of_second = own.line(b, a, distance, part);
  const double energy = cubic_at(of_first.pair, part) / distance;
  return {energy, (cubic_slope(of_first.pair, part) * own.knots_per_length - energy) / distance,
          cubic_slope(of_first.density, part) * own.knots_per_length,
          cubic_slope(of_second.density, part) * own.knots_per_length};
}

std::size_t EmbeddedAtoms::memory_bytes() const {
  const Impl& own = *impl_;
  return own.lines.capacity() * sizeof(EmbeddedLine) + own.embeddings.capacity() * sizeof(Cubic) +
         (own.points.capacity() + own.forces.capacity()) * sizeof(PointAndNumber) +
         (own.near.capacity() + own.near_counts.capacity()) * sizeof(std::int32_t);
}

}  // namespace dch

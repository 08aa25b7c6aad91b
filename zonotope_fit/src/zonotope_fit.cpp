// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/zonotope_fit/zonotope_fit.hpp>

#include "base/describe.hpp"
#include "fit_problem.hpp"

namespace dch::zonotope {
namespace {

using Eigen::Index;

constexpr double kRounding = 1e-14;  // of the extent: of a point's height along a unit vector

/// Makes up for what the solver's tolerance left: all lengths by one factor, or where none reaches along a
/// normal the one that reaches farthest by what is missing.
void enlarge(const FitRows& rows, FitLengths& found) {
  double factor = 1;
  const Eigen::VectorXd reaches = rows.reach(found.lengths);
  for (Index n = 0; n < rows.normals.cols(); ++n) {
    const double height = rows.normals.col(n).dot(found.center);
    const double wanted = std::max(rows.up(n) - height, rows.down(n) + height);
    if (!(wanted > reaches(n) + kRounding)) continue;
    const Eigen::VectorXd rates = (rows.directions.transpose() * rows.normals.col(n)).cwiseAbs();
    double reach = rates.dot(found.lengths);
    if (wanted > reach && !(reach > 1e-6)) {
      Index longest = 0;
      const double rate = rates.maxCoeff(&longest);
      found.lengths(longest) += (wanted - reach) / rate;
      reach = wanted;
    }
    if (wanted > reach) factor = std::max(factor, wanted / reach);
  }
  found.lengths *= factor;
}

Coordinates coordinates(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

}  // namespace

FittedZonotope oriented_zonotope(const std::vector<Coordinates>& points,
                                 const std::vector<Coordinates>& directions) {
  const FitProblem problem(points, directions);
  FittedZonotope result;
  result.center = coordinates(problem.origin);
  for (Index k = 0; k < problem.directions.cols(); ++k)
    result.directions.push_back(coordinates((problem.basis * problem.directions.col(k)).normalized()));
  result.lengths.assign(directions.size(), 0);
  if (problem.directions.rows() == 0) return result;
  const FitRows rows(problem);
  FitLengths found = least_lengths(rows);
  enlarge(rows, found);
  result.center = coordinates(problem.origin + problem.extent * (problem.basis * found.center));
  for (Index k = 0; k < found.lengths.size(); ++k)
    result.lengths[static_cast<std::size_t>(k)] = problem.extent * found.lengths(k);
  for (const double length : result.lengths) result.total_length += length;
  result.normals = rows.normals.cols();
  result.rows = found.rows;
  result.programs = found.programs;
  return result;
}

std::vector<Coordinates> direction_grid(int dimension, double distance) {
  if (dimension < 1 || !(distance > 0))
    throw InvalidParameter("a grid of directions in " + std::to_string(dimension) +
                           " dimensions to a distance of " + detail::describe(distance) +
                           " does not exist; give at least 1, and a distance above 0");
  const auto d = static_cast<std::size_t>(dimension);
  const auto cells =
      static_cast<std::size_t>(std::max(1.0, std::ceil(std::sqrt(dimension - 1.0) / distance)));
  std::vector<Coordinates> result;
  for (std::size_t face = 0; face < d; ++face) {
    std::vector<std::size_t> cell(d, 0);
    for (bool is_done = false; !is_done;) {
      Coordinates v(d, 1);
      double square = 0;
      for (std::size_t axis = 0; axis < d; ++axis) {
        if (axis != face)
          v[axis] = (2 * static_cast<double>(cell[axis]) + 1) / static_cast<double>(cells) - 1;
        square += v[axis] * v[axis];
      }
      for (double& x : v) x /= std::sqrt(square);
      result.push_back(std::move(v));
      is_done = true;  // counts up
      for (std::size_t axis = 0; axis < d && is_done; ++axis) {
        if (axis == face) continue;
        is_done = ++cell[axis] == cells;
        if (is_done) cell[axis] = 0;
      }
    }
  }
  return result;
}

FittedZonotope least_length_zonotope(const std::vector<Coordinates>& points, double epsilon) {
  if (!(epsilon >= 0.05 && epsilon <= 2))
    throw InvalidParameter("epsilon = " + detail::describe(epsilon) +
                           " is not within 0.05..2; choose another");
  if (points.empty() || points[0].empty()) return oriented_zonotope(points, {});
  const std::size_t d = points[0].size();
  std::vector<Coordinates> directions = direction_grid(static_cast<int>(d), epsilon / static_cast<double>(d));
  for (std::size_t axis = 0; axis < d; ++axis) {
    directions.emplace_back(d, 0.0);
    directions.back()[axis] = 1;
  }
  return oriented_zonotope(points, directions);
}

namespace {

void check_dimension(const FittedZonotope& fitted, std::size_t dimension) {
  if (fitted.center.size() == dimension) return;
  throw InvalidParameter("the zonotope has " + std::to_string(fitted.center.size()) + " dimensions, not " +
                         std::to_string(dimension) + "; use its directions and lengths");
}

}  // namespace

Zonotope in_space(const FittedZonotope& fitted) {
  check_dimension(fitted, 3);
  Zonotope result{{fitted.center[0], fitted.center[1], fitted.center[2]}, {}};
  for (std::size_t k = 0; k < fitted.lengths.size(); ++k) {
    const Coordinates& v = fitted.directions[k];
    if (fitted.lengths[k] > 0) result.generators.push_back(fitted.lengths[k] * Vec3{v[0], v[1], v[2]});
  }
  return result;
}

Zonogon in_plane(const FittedZonotope& fitted) {
  check_dimension(fitted, 2);
  Zonogon result{{fitted.center[0], fitted.center[1]}, {}};
  for (std::size_t k = 0; k < fitted.lengths.size(); ++k) {
    const Coordinates& v = fitted.directions[k];
    if (fitted.lengths[k] > 0) result.generators.push_back(fitted.lengths[k] * Vec2{v[0], v[1]});
  }
  return result;
}

}  // namespace dch::zonotope

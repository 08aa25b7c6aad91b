// SPDX-License-Identifier: MIT
#include "fit_problem.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include <dch/base/error.hpp>

#include "base/describe.hpp"

namespace dch::zonotope {
namespace {

using detail::describe;
using Eigen::Index;

constexpr double kParallel = 1e-10;  // of unit vectors: below this a set of directions counts as dependent
constexpr double kOffSpan = 1e-9;    // of the extent
constexpr double kMaxNormals = 1e7;

Eigen::MatrixXd columns(const std::vector<Coordinates>& vectors, std::size_t dimension, const char* what) {
  Eigen::MatrixXd result(static_cast<Index>(dimension), static_cast<Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const std::string name = std::string(what) + " " + std::to_string(k);
    if (vectors[k].size() != dimension)
      throw InvalidParameter(name + " has " + std::to_string(vectors[k].size()) +
                             " coordinates, but point 0 has " + std::to_string(dimension) +
                             "; give all the same number");
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const double x = vectors[k][axis];
      if (!(std::abs(x) <= kMaxMagnitude))
        throw InvalidParameter(name + " has a coordinate of " + describe(x) +
                               ", which is not finite or beyond " + describe(kMaxMagnitude) +
                               "; check the coordinates");
      result(static_cast<Index>(axis), static_cast<Index>(k)) = x;
    }
  }
  return result;
}

/// The vector across all but one dimension's worth of others, or 0 if those are dependent.
Eigen::VectorXd normal_of(const Eigen::MatrixXd& vectors) {
  const Index d = vectors.rows();
  if (d == 1) return Eigen::VectorXd::Ones(1);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(vectors);
  if (std::abs(qr.matrixR()(d - 2, d - 2)) < kParallel) return Eigen::VectorXd::Zero(d);
  Eigen::VectorXd normal = Eigen::VectorXd::Unit(d, d - 1);
  normal.applyOnTheLeft(qr.householderQ());
  return normal;
}

bool is_next_subset(std::vector<Index>& subset, Index count) {
  const auto size = static_cast<Index>(subset.size());
  Index at = size - 1;
  while (at >= 0 && subset[static_cast<std::size_t>(at)] == count - size + at) --at;
  if (at < 0) return false;
  ++subset[static_cast<std::size_t>(at)];
  for (Index next = at + 1; next < size; ++next)
    subset[static_cast<std::size_t>(next)] = subset[static_cast<std::size_t>(next - 1)] + 1;
  return true;
}

double subsets(Index count, Index size) {
  double result = 1;
  for (Index k = 0; k < size; ++k) result *= static_cast<double>(count - k) / static_cast<double>(k + 1);
  return result;
}

}  // namespace

FitProblem::FitProblem(const std::vector<Coordinates>& given_points,
                       const std::vector<Coordinates>& given_directions) {
  if (given_points.empty())
    throw InvalidParameter("there are 0 points to enclose by a zonotope; give at least 1");
  const std::size_t dimension = given_points[0].size();
  if (dimension == 0) throw InvalidParameter("point 0 has 0 coordinates; give at least 1");
  points = columns(given_points, dimension, "point");
  directions = columns(given_directions, dimension, "direction");
  for (Index k = 0; k < directions.cols(); ++k) {
    const double largest = directions.col(k).cwiseAbs().maxCoeff();
    if (largest == 0) throw InvalidParameter("direction " + std::to_string(k) + " is 0; leave it out");
    directions.col(k) = (directions.col(k) / largest).normalized();
  }
  origin = points.col(0);
  points.colwise() -= origin;
  extent = points.cwiseAbs().maxCoeff();
  if (extent > 0) points /= extent;
  Index rank = 0;
  basis = Eigen::MatrixXd::Identity(points.rows(), points.rows());
  if (directions.cols() > 0) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(directions);
    qr.setThreshold(kParallel);
    rank = qr.rank();
    if (rank < points.rows()) basis = Eigen::MatrixXd(qr.householderQ()).leftCols(rank);
  } else {
    basis.resize(points.rows(), 0);
  }
  const Eigen::MatrixXd inside = basis.transpose() * points;
  const Eigen::MatrixXd off = points - basis * inside;
  for (Index k = 0; k < off.cols(); ++k)
    if (off.col(k).norm() > kOffSpan)
      throw InvalidParameter("point " + std::to_string(k) + " is " + describe(extent * off.col(k).norm()) +
                             " off the space that the directions span through point 0, of dimension " +
                             std::to_string(rank) + "; add a direction");
  points = inside;
  directions = basis.transpose() * directions;
}

FitRows::FitRows(const FitProblem& problem) {
  const Eigen::MatrixXd& v = problem.directions;
  const Index d = v.rows(), k = v.cols();
  const double count = subsets(k, d - 1);
  if (count > kMaxNormals)
    throw InvalidParameter(std::to_string(k) + " directions in " + std::to_string(d) + " dimensions have " +
                           describe(count) + " normals, more than " + describe(kMaxNormals) +
                           "; give fewer directions");
  std::vector<Index> subset(static_cast<std::size_t>(d - 1));
  for (Index at = 0; at < d - 1; ++at) subset[static_cast<std::size_t>(at)] = at;
  Eigen::MatrixXd found(d, static_cast<Index>(std::llround(count))), chosen(d, d - 1);
  Index size = 0;
  do {
    for (Index at = 0; at < d - 1; ++at) chosen.col(at) = v.col(subset[static_cast<std::size_t>(at)]);
    const Eigen::VectorXd normal = normal_of(chosen);
    if (normal.squaredNorm() > 0) found.col(size++) = normal;
  } while (is_next_subset(subset, k));
  normals = found.leftCols(size);
  directions = v;
  up.resize(size);
  down.resize(size);
  for (Index n = 0; n < size; ++n) {
    const Eigen::VectorXd heights = problem.points.transpose() * normals.col(n);
    up(n) = heights.maxCoeff();
    down(n) = -heights.minCoeff();
  }
}

Eigen::VectorXd FitRows::reach(const Eigen::VectorXd& lengths) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(normals.cols());
  for (Index k = 0; k < lengths.size(); ++k)
    if (lengths(k) > 0) sum += lengths(k) * (normals.transpose() * directions.col(k)).cwiseAbs();
  return sum;
}

}  // namespace dch::zonotope

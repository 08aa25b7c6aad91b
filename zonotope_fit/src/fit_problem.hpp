// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <dch/zonotope_fit/zonotope_fit.hpp>

namespace dch::zonotope {

/// Points and directions in the space that the directions span, scaled so that the points' extent is 1.
struct FitProblem {
  Eigen::MatrixXd points, directions;  ///< in columns
  Eigen::MatrixXd basis;               ///< of that space, in columns
  Eigen::VectorXd origin;              ///< the first point
  double extent = 0;                   ///< [length]

  FitProblem(const std::vector<Coordinates>& points, const std::vector<Coordinates>& directions);
};

/// The normals of the arrangement, and how far the points reach along them and against them.
struct FitRows {
  Eigen::MatrixXd directions, normals;  ///< in columns
  Eigen::VectorXd up, down;             ///< max n . p_j and max -n . p_j

  explicit FitRows(const FitProblem& problem);
  /// sum c_i |n . v_i| for each normal n. Only the lengths that are not 0 cost: a solution has few.
  Eigen::VectorXd reach(const Eigen::VectorXd& lengths) const;
};

/// What the linear program found.
struct FitLengths {
  Eigen::VectorXd center, lengths;
  std::int64_t rows = 0;
  int programs = 0;
};

/// @throws Error if the solver fails
FitLengths least_lengths(const FitRows& rows);

}  // namespace dch::zonotope

// SPDX-License-Identifier: MIT
#include <ClpSimplex.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/error.hpp>

#include "base/describe.hpp"
#include "fit_problem.hpp"

namespace dch::zonotope {
namespace {

using Eigen::Index;

constexpr double kViolation = 1e-9;       // of the extent, beside the solver's own tolerance of 1e-9
constexpr std::size_t kRowsAtOnce = 400;  // the most violated ones first
constexpr int kPrograms = 500;            // a dozen are enough
constexpr double kNoReach = 1e-12;  // of unit vectors: a direction in the plane of a normal, but for rounding

/// A normal, or its opposite.
struct Row {
  double violation;
  Index normal;
  bool is_opposite;
};

/// Lengths come first, then the coordinates of the center.
class Program {
 public:
  explicit Program(const FitRows& rows)
      : rows_(rows), lengths_(rows.directions.cols()), dimension_(rows.normals.rows()) {
    model_.setLogLevel(0);
    model_.setPrimalTolerance(1e-9);
    model_.setDualTolerance(1e-9);
    model_.resize(0, static_cast<int>(lengths_ + dimension_));
    for (Index k = 0; k < lengths_ + dimension_; ++k) {
      model_.setObjectiveCoefficient(static_cast<int>(k), k < lengths_ ? 1 : 0);
      model_.setColumnBounds(static_cast<int>(k), k < lengths_ ? 0 : -COIN_DBL_MAX, COIN_DBL_MAX);
    }
  }

  void add(const Row& row) {
    std::vector<int> columns;
    std::vector<double> values;
    const Eigen::VectorXd reaches = (rows_.directions.transpose() * rows_.normals.col(row.normal)).cwiseAbs();
    for (Index k = 0; k < lengths_; ++k) push(columns, values, k, reaches(k));
    for (Index k = 0; k < dimension_; ++k)
      push(columns, values, lengths_ + k, (row.is_opposite ? -1 : 1) * rows_.normals(k, row.normal));
    const double least = row.is_opposite ? rows_.down(row.normal) : rows_.up(row.normal);
    model_.addRow(static_cast<int>(columns.size()), columns.data(), values.data(), least, COIN_DBL_MAX);
  }

  void solve(FitLengths& result) {
    model_.dual();
    if (!is_optimal())
      throw Error("the linear program of an enclosing zonotope with " + std::to_string(model_.numberRows()) +
                  " rows was not solved (status " + std::to_string(model_.status()) +
                  " of CLP); give other directions");
    const double* const solution = model_.getColSolution();
    result.lengths = Eigen::Map<const Eigen::VectorXd>(solution, lengths_).cwiseMax(0);
    result.center = Eigen::Map<const Eigen::VectorXd>(solution + lengths_, dimension_);
    result.rows = model_.numberRows();
    ++result.programs;
  }

 private:
  /// Whether the prices are a solution of the dual program, and its value is that of the primal one: then no
  /// lengths have a smaller sum (weak duality).
  bool is_optimal() const {
    if (!model_.isProvenOptimal()) return false;
    double value = 0, least_price = 0, off = 0;
    for (int row = 0; row < model_.numberRows(); ++row) {
      value += model_.getRowPrice()[row] * model_.getRowLower()[row];
      least_price = std::min(least_price, model_.getRowPrice()[row]);
    }
    for (int column = 0; column < model_.numberColumns(); ++column) {
      const double cost = model_.getReducedCost()[column];
      off = std::max(off, column < lengths_ ? -cost : std::abs(cost));
    }
    return least_price > -1e-7 && off < 1e-7 &&
           std::abs(value - model_.getObjValue()) <= 1e-8 * (1 + std::abs(value));
  }

  /// What should be 0 and is not, by rounding, is left out: CLP would divide by it.
  static void push(std::vector<int>& columns, std::vector<double>& values, Index column, double value) {
    if (std::abs(value) < kNoReach) return;
    columns.push_back(static_cast<int>(column));
    values.push_back(value);
  }

  const FitRows& rows_;
  Index lengths_, dimension_;
  ClpSimplex model_;
};

std::vector<Row> violated(const FitRows& rows, const FitLengths& at) {
  const Eigen::VectorXd reach = rows.reach(at.lengths), height = rows.normals.transpose() * at.center;
  std::vector<Row> result;
  for (Index n = 0; n < reach.size(); ++n) {
    const double up = rows.up(n) - height(n) - reach(n), down = rows.down(n) + height(n) - reach(n);
    if (up > kViolation) result.push_back({up, n, false});
    if (down > kViolation) result.push_back({down, n, true});
  }
  std::sort(result.begin(), result.end(), [](const Row& a, const Row& b) {
    return a.violation != b.violation
               ? a.violation > b.violation
               : std::pair(a.normal, a.is_opposite) < std::pair(b.normal, b.is_opposite);
  });
  return result;
}

}  // namespace

FitLengths least_lengths(const FitRows& rows) {
  FitLengths result;
  result.lengths = Eigen::VectorXd::Zero(rows.directions.cols());
  result.center = Eigen::VectorXd::Zero(rows.normals.rows());
  Program program(rows);
  for (std::vector<Row> missing = violated(rows, result); !missing.empty() && result.programs < kPrograms;
       missing = violated(rows, result)) {
    if (missing.size() > kRowsAtOnce) missing.resize(kRowsAtOnce);
    for (const Row& row : missing) program.add(row);
    program.solve(result);
  }
  return result;
}

}  // namespace dch::zonotope

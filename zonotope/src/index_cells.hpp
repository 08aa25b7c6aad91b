// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/vec3.hpp>

#include "normal_cut.hpp"

namespace dch::zonotope {

/// The plane of normals (x, y, 1), cut into strips and these into bands, so that few generators' lines cross
/// each cell.
class IndexCells {
 public:
  struct Cell {
    std::vector<std::size_t> generators;  ///< whose lines cross it
    Vec3 gradient;                        ///< of what the others add to h
  };

  std::vector<Vec3> generators;  ///< each with y > 0, so that n . u > 0 above its line
  std::int64_t entries = 0;

  void build(std::vector<Vec3> given, std::size_t strips);

  /// A cell by its strip and band.
  struct Place {
    std::size_t strip = SIZE_MAX, band = 0;
    bool is_nowhere() const { return strip == SIZE_MAX; }
  };

  /// Where (n . x) / h(n) is largest; nowhere if that is at infinity.
  Place find(Vec3 x, std::int64_t& operations) const;
  const Cell& cell(Place place) const { return strips_[place.strip].cells[place.band]; }
  /// Whether a normal is in a cell, to rounding.
  bool holds(Place place, Vec3 normal) const;

 private:
  struct Strip {
    std::vector<NormalCut> cuts;  ///< between its bands, from below
    std::vector<Cell> cells;
  };
  struct Side {
    int side;  ///< -1, 0, 1: where the largest quotient is
    double y;  ///< of the largest on the cut itself
  };

  std::vector<double> borders_of(std::size_t strips) const;
  NormalCut border_at(double x) const;
  void build_strip(std::size_t left);
  void add_to_cells(Strip& strip, const std::vector<std::size_t>& left,
                    const std::vector<std::size_t>& right) const;
  Side beside(std::size_t border, Vec3 x, std::int64_t& operations) const;
  int above(const NormalCut& cut, Vec3 x, Side left, Side right, std::int64_t& operations) const;
  double slope(std::size_t k) const { return -generators[k].x / generators[k].y; }
  double height(std::size_t k, double x) const { return slope(k) * x - generators[k].z / generators[k].y; }

  std::size_t band_ = 1;            ///< how many lines cross a border within a band
  std::vector<NormalCut> borders_;  ///< vertical lines: t is y
  std::vector<Strip> strips_;
};

}  // namespace dch::zonotope

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/neighbor_list.hpp>

#include "grid_kernels.hpp"
#include "size_layer.hpp"

namespace dch::bench {

/// The baseline for particles with radii: grids for several sizes, each with cells that fit its particles, as
/// hierarchical grids have them (Krijgsman, Ogarko and Luding, Comput. Part. Mech. 1:357, 2014), with the
/// kernels that the hierarchy's lists use. Particles of one grid meet by the half stencil; larger ones look
/// for smaller ones among the cells around them. Built from scratch for every list.
///
/// Periodic cubes, at most kMaxParticles particles.
class SizeGrid {
 public:
  /// @param level_ratio of the largest to the smallest radius in one grid, above 1; the smallest particles
  /// begin
  /// @param cell_width relative to the largest list distance of a grid's own pairs
  /// @throws std::invalid_argument if the box is no periodic cube, or there are too many particles
  SizeGrid(Span<const double> radii, double skin, const Box& box, double level_ratio, double cell_width);

  /// Unsorted half list of all pairs within r_i + r_j + skin.
  void list(Span<const Vec3> positions, const Box& box, NeighborList& out);
  std::size_t memory_bytes() const;
  /// Number of grids.
  std::size_t layers() const { return layers_.size(); }

 private:
  using Run = SizeLayer::Run;
  struct Store {
    std::vector<std::int16_t> x, y, z;
    std::vector<std::int32_t> word;
    void make_room(std::size_t count);
    detail::Candidates at(std::int32_t k) {
      return {x.data() + k, y.data() + k, z.data() + k, word.data() + k};
    }
  };
  struct Layer : SizeLayer {
    int shift = 0;    ///< from fractions of 2^32 to units
    double unit = 1;  ///< [length]
    double blur = 0;  ///< by which a distance in units less its limit may be off
  };
  struct Scene {
    Span<const Vec3> positions;
    const Box& box;
    NeighborList& out;
  };

  void fit_units(std::size_t layer);
  std::int16_t band(const Layer& layer) const;
  std::int16_t limit(const Layer& layer, double distance) const;
  void append(const Layer& layer, const SizeLayer& from, Run run);
  void rows_of_cell(std::size_t layer, std::int32_t cell, const Scene& scene);
  void rows_of_particle(std::size_t layer, std::int32_t place, const Scene& scene);
  void add_smaller(std::size_t layer, Run own, Vec3 low, Vec3 high);
  void rows_of_block(const Layer& layer, Run block, std::int32_t before, const Scene& scene);
  std::int32_t test_block(const Layer& layer, const detail::BlockPoints& points, const std::int16_t* reach,
                          std::int32_t count);
  void decide(Run block, std::int32_t open, std::int32_t chunks, const Layer& layer, const Scene& scene);
  bool in_list(std::int32_t i, std::int32_t j, const Scene& scene) const;

  Span<const double> radii_;
  double skin_, side_, largest_ = 0, per_code_ = 0;
  std::vector<Layer> layers_;  ///< from the smallest particles to the largest
  Store around_, near_;
  std::int32_t count_ = 0;  ///< of around_
  std::vector<std::int32_t> number_;
  std::vector<std::int16_t> radius_;
  std::vector<std::uint32_t> mask_;
  std::vector<Unsettled> unsettled_;
  const FrozenKernels* kernels_ = nullptr;
};

}  // namespace dch::bench

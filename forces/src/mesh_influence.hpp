// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/forces/ewald_mesh.hpp>
#include <dch/geometry/box.hpp>

#include "simd/mesh_task.hpp"

namespace dch::detail {

/// The vectors whose products with a position are its coordinates in units of the cell's vectors.
std::array<Vec3, 3> reciprocal_vectors(const Box& box);

/// What the waves of a lattice sum weigh.
struct LatticeWeights {
  LatticeSum of;
  double splitting, constant;
};

/// The influence function of a mesh: weights of waves over the moduli of splines.
class MeshInfluence {
 public:
  MeshInfluence(const std::array<int, 3>& sizes, LatticeWeights weights, const MeshKernels& kernels);
  void set_box(const Box& box);
  /// Of the waves with number x along the first axis, [z][y], for the box that was set; 0 for the wave
  /// without length.
  void fill_plane(int x, float* at) const;
  /// The weight of the wave without length, which exerts no force.
  double of_mean() const { return weights_.of == LatticeSum::dispersion ? scale_ : 0; }

 private:
  double weight(double x, double y, double z) const;

  std::array<int, 3> sizes_;
  LatticeWeights weights_;
  std::array<std::vector<double>, 3> moduli_;
  std::array<Vec3, 3> reciprocal_;
  double scale_ = 0;  ///< of the weights
};

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// Functions of the embedded atom method, by their values at equal distances from 0 on. Between two of them
/// stands the cubic whose slopes at both are differences of their neighbors, of fourth order but at the ends;
/// beyond the last one a function stays as it is, and an embedding energy goes on in a line with the slope at
/// its end.
struct EmbeddedAtomParams {
  int types = 1;
  double cutoff = 0;         ///< of pairs [length]
  double distance_step = 0;  ///< between two values of functions of the distance [length]
  double density_step = 0;   ///< between two values of embedding energies [density]
  double line_from = 0;      ///< where embedding energies go on in a line; 0: at their last value [density]
  /// Of type a, that an atom of type b adds to the density of one of type a, at [a * types + b].
  std::vector<std::vector<double>> densities;
  /// Of a pair of types its energy times the distance, at [a * types + b] and [b * types + a].
  std::vector<std::vector<double>> pairs;
  std::vector<std::vector<double>> embeddings;  ///< energies by type
};

/// A half neighbor list. Atoms have a row each, which may hold bits beside the numbers of neighbors.
struct NeighborRows {
  Span<const std::int32_t> atoms;        ///< that have rows
  const std::int32_t* counts;            ///< of neighbors, by atom
  const std::int32_t* const* neighbors;  ///< by atom
  std::int32_t number_bits = 0x7FFFFFFF;
};

/// A pair within the cutoff.
struct EmbeddedPair {
  std::int32_t i, j;
  Vec3 from_j_to_i;     ///< [length]
  double energy;        ///< without that of embedding
  double force_over_r;  ///< of repulsion, embedding included [force/length]
};

/// Embedded atoms: E = sum_i F(sum_j rho(r_ij)) + 1/2 sum_ij phi(r_ij), by Daw and Baskes, Phys. Rev. B 29,
/// 6443 (1984), in double precision, by SIMD kernels for the instruction set in use. Densities come first,
/// then the slopes of embedding energies, which are the caller's to exchange between processes, then forces.
/// An object keeps what the two have in common, so that one step at a time may use it.
class EmbeddedAtoms {
 public:
  /// @throws InvalidParameter if numbers of functions or of their values, steps or the cutoff do not fit.
  explicit EmbeddedAtoms(const EmbeddedAtomParams& params);
  ~EmbeddedAtoms();
  EmbeddedAtoms(EmbeddedAtoms&&) noexcept;
  EmbeddedAtoms& operator=(EmbeddedAtoms&&) noexcept;

  /// Adds what pairs within the cutoff add to the densities of both their atoms. Positions are taken as
  /// given, without images. Cost O(neighbors).
  /// @param types from 1
  /// @throws InvalidParameter if there are not as many numbers of each kind as positions. Numbers of
  ///   neighbors and types are not checked.
  void add_densities(const NeighborRows& rows, Span<const Vec3> positions, Span<const std::int32_t> types,
                     Span<double> densities);

  struct Embedding {
    double energy, slope;
  };
  /// Of an atom of a type, from 1.
  Embedding embedding(int type, double density) const;

  using PairVisitor = std::function<void(Span<const EmbeddedPair>)>;
  /// Adds forces on both atoms of each pair that add_densities() has found.
  /// @param rows the same
  /// @param types the same
  /// @param slopes of embedding energies, by atom
  /// @param visit gets the pairs of each row, unless it is empty
  /// @returns the energy of pairs
  /// @throws InvalidParameter as add_densities()
  double add_forces(const NeighborRows& rows, Span<const std::int32_t> types, Span<const double> slopes,
                    Span<Vec3> forces, const PairVisitor& visit = {});

  /// How many pairs within the cutoff add_densities() has found in the row of an atom.
  std::int32_t pairs_of(std::int32_t atom) const;

  /// Of two atoms at a distance, of these types, from 1.
  struct OfPair {
    double energy, slope;                                          ///< of phi(r)
    double slope_of_density_of_first, slope_of_density_of_second;  ///< which each gets from the other
  };
  OfPair of_pair(int first, int second, double distance) const;

  std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dch
#pragma GCC visibility pop

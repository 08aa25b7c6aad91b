// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

#pragma GCC visibility push(default)
namespace dch {

/// How spheres that overlap push each other, after Cundall and Strack, as LAMMPS's styles gran do. With d
/// from j to i, r = |d|, overlap o = R_i + R_j - r, effective mass m and velocity v_n along d and v_t across
/// it, spins included:
///
/// * along d: k_n o - m gamma_n v_n
/// * across d, with the history s of a contact: -(k_t s + m gamma_t v_t), at most friction times the force
///   along d. s is v_t added up over time, turned with the contact, and shortened where it slides.
enum class ContactForm {
  hooke,          ///< no history: m gamma_t v_t across d, at most friction
  hooke_history,  ///< all of the above
  hertz_history   ///< the same times sqrt(o R_i R_j / (R_i + R_j))
};

struct ContactParams {
  ContactForm form = ContactForm::hooke_history;
  double stiffness = 0;         ///< k_n [force/length], [force/length^2] of hertz_history
  double shear_stiffness = 0;   ///< k_t, the same
  double damping = 0;           ///< gamma_n [1/time], [1/(time length)]
  double shear_damping = 0;     ///< gamma_t, the same
  double friction = 0;          ///< of forces across over those along
  bool limits_damping = false;  ///< whether damping never turns the force along d into a pull
};

struct GrainBody {
  double radius = 0;  ///< [length]
  double mass = 0;
  double frozen = 0;  ///< 1 if it never moves: the effective mass of a pair is that of the other one; else 0
};

/// What is known of particles, and what is added to.
struct Grains {
  Span<const Vec3> positions, velocities, spins;
  Span<const GrainBody> bodies;
  std::size_t owned = 0;  ///< those from here on get no forces as the second of a pair
  Span<Vec3> forces, torques;
};

/// Pairs that may touch, with what is kept of each of them. Forms without history keep nothing: both spans
/// are empty.
struct ListedContacts {
  Span<const std::int32_t> i, j;
  Span<std::int32_t> touching;  ///< written: 1 for those that touch, 0 for others
  Span<Vec3> slips;             ///< s, followed where a pair touches, 0 elsewhere [length]
};

/// A pair that touches.
struct GrainContact {
  std::int32_t i, j;
  Vec3 from_j_to_i;  ///< [length]
  Vec3 force;        ///< on i, the opposite on j
};

/// Forces of contacts, with SIMD kernels for the instruction set in use.
class GrainContacts {
 public:
  /// @throws InvalidParameter for numbers that are negative or not finite.
  explicit GrainContacts(const ContactParams& params);

  /// Adds forces and torques of the pairs that touch, those whose distance is below the sum of the radii.
  /// Positions are taken as given, without images. Pairs go in their order, in double precision; whether two
  /// touch does not depend on the instruction set.
  /// @param timestep by which contacts slip on; below 0 they neither slip nor turn, as before a first step
  /// @param found gets the pairs that touch unless it is null
  /// @throws InvalidParameter if there are not as many numbers of each kind as particles, or as pairs.
  /// Numbers
  ///   of particles in pairs are not checked.
  void add_forces(const Grains& grains, const ListedContacts& pairs, double timestep,
                  std::vector<GrainContact>* found = nullptr) const;

  const ContactParams& params() const { return params_; }

 private:
  ContactParams params_;
};

}  // namespace dch
#pragma GCC visibility pop

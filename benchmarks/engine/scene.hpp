// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch::bench {

/// Where particles are, one configuration after the other, and which lists are wanted of each. Lengths are in
/// the scene's own unit (reduced units, or nm for water).
class Scene {
 public:
  virtual ~Scene() = default;

  /// Goes to the next configuration, about 10 steps of dynamics later; false if there is none.
  virtual bool step() = 0;
  /// Goes back to the first configuration.
  virtual void restart() = 0;

  std::string name;
  std::string origin;  ///< what the configurations are, for people
  std::vector<Vec3> positions;
  Box box;
  std::vector<double> list_radii;  ///< one list each, ascending; empty if particles have radii [length]
  std::vector<double> radii;       ///< by particle: pairs within r_i + r_j + skin; or empty [length]
  double skin = 0;                 ///< only with radii [length]
  Exclusions exclusions;           ///< pairs left out
};

/// A scene that needs no file: each particle moves at random from one configuration to the next.
class RandomScene : public Scene {
 public:
  /// @param seed of the motion; restart() starts it anew
  explicit RandomScene(std::uint64_t seed) : seed_(seed), engine_(seed) {}
  bool step() override;
  void restart() override;

  /// Takes the positions as the first configuration.
  void start();

  double step_length = 0;   ///< largest random displacement along an axis [length]
  bool tethered = false;    ///< displacements start from the first configuration each time
  std::vector<Vec3> drift;  ///< by particle: displacement in every step; or empty [length]
  /// Shear strain of a step: x grows by this much of y, and with the particles the box tilts, until it is
  /// flipped back at half its width.
  double strain = 0;

 private:
  void shear();

  std::uint64_t seed_;
  std::mt19937_64 engine_;
  std::vector<Vec3> first_;
  Box first_box_;
};

/// Uniform in [0, 1); the same on every platform, which std::uniform_real_distribution is not.
inline double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

// Artificial scenes. `scale` multiplies the number of particles, for quick checks of the program.

/// A simple cubic lattice of the density of the Lennard-Jones melt (0.8442), thoroughly shaken.
std::unique_ptr<RandomScene> make_shaken_lattice(double atoms, double list_radius);
/// A droplet of liquid in the middle of a box 100 times as wide; `gas_atoms` fly through the rest.
std::unique_ptr<RandomScene> make_droplet(double scale, double gas_atoms);
/// Centers clustered hierarchically: the number of others within s of one grows as a power of s below 3
/// (Soneira and Peebles, Astron. J. 83:845, 1978).
std::unique_ptr<RandomScene> make_power_law_clusters(double scale);
/// A self-avoiding walk of 20,000 beads in a wide box, bonded ones left out.
std::unique_ptr<RandomScene> make_swollen_chain(double scale);
/// The melt's shaken lattice in a box that tilts by 1/40 of its height from one configuration to the next.
std::unique_ptr<RandomScene> make_sheared_lattice(double scale);
/// The melt's shaken lattice, whose atoms vibrate about their places as far as in a solid at temperature 0.1.
std::unique_ptr<RandomScene> make_glass(double scale);
/// Atoms of density 0.05 that fly straight on, as fast as at temperature 10.
std::unique_ptr<RandomScene> make_hot_gas(double scale);
/// Few large spheres among many small ones; the volume fractions are the same whatever the ratio of sizes.
std::unique_ptr<RandomScene> make_two_sizes(double scale, double ratio);
/// Large spheres with 200 small ones at the surface of each; the large ones are 2,048 at scale 1.
std::unique_ptr<RandomScene> make_colloids(double scale, double ratio);
/// Spheres whose number density falls as the fourth power of the radius, from the smallest to `ratio` times
/// as large.
std::unique_ptr<RandomScene> make_continuous_sizes(double scale, double ratio);

/// Names of all scenes, in the order of the table.
const std::vector<std::string>& scene_names();

/// Where make_scene() looks for files and how large it makes what it makes itself.
struct SceneOptions {
  std::string trajectories;     ///< folder that make_trajectories filled
  double scale = 1;             ///< of the number of particles in artificial scenes
  std::size_t most_frames = 0;  ///< configurations to read of a file
  bool streamed = false;        ///< read when they are wanted, not all before the first
};

/// A scene by its name. A melt or chain melt without its trajectory becomes a shaken lattice, and says so in
/// `origin`.
/// @throws Error for an unknown name, or a file that cannot be read.
std::unique_ptr<Scene> make_scene(const std::string& name, const SceneOptions& options);

}  // namespace dch::bench

// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <dch/necklace/enclosing_ball.hpp>

#include "random.hpp"

namespace dch::scenes {

struct NamedBalls {
  std::string name;
  std::vector<necklace::Ball> balls;
};

/// n balls in a cube of side 2, radii from `largest` / ratio to `largest`, evenly in their logarithm.
inline std::vector<necklace::Ball> random_balls(std::size_t n, double largest, double ratio,
                                                std::uint64_t seed) {
  Random random(seed);
  std::vector<necklace::Ball> balls(n);
  for (necklace::Ball& ball : balls) {
    ball.center = random.in_cube(1);
    ball.radius = largest * std::pow(ratio, -random.uniform());
  }
  return balls;
}

/// Balls that lead rounding astray: many bases, or none that is well conditioned.
inline std::vector<NamedBalls> hard_balls() {
  std::vector<NamedBalls> scenes;
  NamedBalls cube{"cube corners", {}};
  for (int k = 0; k < 8; ++k) {
    cube.balls.push_back({{double(k & 1), double(k >> 1 & 1), double(k >> 2 & 1)}, 0});
  }
  NamedBalls sphere{"on a sphere", {}}, circle{"on a circle", {}}, line{"on a line", {}};
  Random random(7);
  for (int k = 0; k < 200; ++k) {
    Vec3 p;
    while (norm2(p) < 0.01) p = random.in_ball(1);
    sphere.balls.push_back({(1 / std::sqrt(norm2(p))) * p, 0.25});
    circle.balls.push_back({{std::cos(0.1 * k), std::sin(0.1 * k), 0}, 0.1});
    line.balls.push_back({{0.7 * k, -0.1 * k, 0.3 * k}, 0.49});
  }
  NamedBalls same{"coincident", std::vector<necklace::Ball>(9, {{1, 2, 3}, 0.5})};
  NamedBalls points{"coincident points", std::vector<necklace::Ball>(5, {{1, 2, 3}, 0})};
  NamedBalls nested{"nested", {}}, touching{"touching one another from within", {}};
  for (int k = 0; k < 20; ++k) {
    nested.balls.push_back({{0.01 * k, 0, 0}, 5 - 0.2 * k});
    touching.balls.push_back({{-0.1 * k, 0, 0}, 5 - 0.1 * k});
  }
  NamedBalls far{"one far away", random_balls(30, 1, 20, 8)};
  far.balls.push_back({{1e12, 0, 0}, 1});
  NamedBalls distant{"all far away", random_balls(30, 1, 20, 9)};
  for (necklace::Ball& ball : distant.balls) ball.center = ball.center + Vec3{1e8, -1e8, 1e8};
  NamedBalls flat{"nearly in a plane", random_balls(100, 0.1, 3, 10)};
  for (necklace::Ball& ball : flat.balls) ball.center.z *= 1e-14;
  NamedBalls grid{"grid", {}};
  for (int k = 0; k < 64; ++k) {
    grid.balls.push_back({{double(k & 3), double(k >> 2 & 3), double(k >> 4)}, 0.49});
  }
  for (NamedBalls* scene :
       {&cube, &sphere, &circle, &line, &same, &points, &nested, &touching, &far, &distant, &flat, &grid}) {
    scenes.push_back(*scene);
  }
  return scenes;
}

}  // namespace dch::scenes

// SPDX-License-Identifier: MIT
#include "write_scene.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <dch/base/error.hpp>

#include "pair_check.hpp"

namespace dch::bench {

void write_scene(Scene& scene, const std::string& folder) {
  const Box& box = scene.box;
  const bool periodic = box.periodic(0) && box.periodic(1) && box.periodic(2);
  if (box.kind() != Box::Kind::orthorhombic || !periodic || box.origin() != Vec3{})
    throw Error(scene.name + ": only scenes in a periodic cuboid at the origin can be written");
  scene.exclusions = {};
  nlohmann::json pairs = nlohmann::json::array();
  const std::size_t lists = std::max<std::size_t>(1, scene.list_radii.size());
  for (std::size_t list = 0; list < lists; ++list) pairs.push_back(expected_pairs(scene, list).pairs);
  const nlohmann::json about = {{"scene", scene.name},
                                {"origin", scene.origin},
                                {"particles", scene.positions.size()},
                                {"box", {box.vector(0).x, box.vector(1).y, box.vector(2).z}},
                                {"list_radii", scene.list_radii},
                                {"radii", scene.radii},
                                {"skin", scene.skin},
                                {"pairs", pairs}};
  const std::filesystem::path path = std::filesystem::path(folder) / scene.name;
  std::ofstream text(path.string() + ".json"), numbers(path.string() + ".f64", std::ios::binary);
  text << about.dump(1) << '\n';
  for (const Vec3 p : scene.positions)
    for (const double coordinate : {p.x, p.y, p.z})
      numbers.write(reinterpret_cast<const char*>(&coordinate), sizeof coordinate);
  if (!text.flush() || !numbers.flush()) throw Error(path.string() + ": cannot be written");
}

}  // namespace dch::bench

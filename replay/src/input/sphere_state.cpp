// SPDX-License-Identifier: MIT
#include "input/sphere_state.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <dch/trajectory/file_error.hpp>

#include "files/input_file.hpp"

namespace dch::cli {
namespace {

using Json = nlohmann::ordered_json;
using trajectory::FileError;

constexpr const char* kKind = "dchmd hardspheres";
constexpr int kVersionOfState = 1;

Json vectors_json(const std::vector<Vec3>& vectors) {
  Json rows = Json::array();
  for (const Vec3 v : vectors) rows.push_back({v.x, v.y, v.z});
  return rows;
}

std::vector<Vec3> vectors_from(const Json& rows) {
  std::vector<Vec3> vectors;
  for (const Json& row : rows) {
    const auto v = row.get<std::array<double, 3>>();
    vectors.push_back({v[0], v[1], v[2]});
  }
  return vectors;
}

std::string read_text(const std::string& path) {
  trajectory::InputFile file(path);
  std::string text(static_cast<std::size_t>(file.size()), '\0');
  text.resize(file.read_at(0, text.data(), text.size()));
  return text;
}

SphereState state_from(const Json& json) {
  if (json.at("kind") != kKind || json.at("schema") != kVersionOfState)
    throw FileError(fmt::format("expected \"kind\": \"{}\" and \"schema\": {}", kKind, kVersionOfState));
  SphereState state;
  json.at("time").get_to(state.time);
  json.at("box_edge").get_to(state.edge);
  json.at("radii").get_to(state.radii);
  json.at("masses").get_to(state.masses);
  state.positions = vectors_from(json.at("positions"));
  state.velocities = vectors_from(json.at("velocities"));
  if (state.positions.size() != state.radii.size())
    throw FileError(fmt::format("{} radii for {} positions", state.radii.size(), state.positions.size()));
  return state;
}

}  // namespace

std::string render_state(const SphereState& state) {
  Json json = {{"kind", kKind}, {"schema", kVersionOfState}, {"time", state.time}, {"box_edge", state.edge}};
  json["radii"] = state.radii;
  json["masses"] = state.masses;
  json["positions"] = vectors_json(state.positions);
  json["velocities"] = vectors_json(state.velocities);
  return json.dump() + "\n";
}

SphereState read_state(const std::string& path) {
  const std::string text = read_text(path);
  try {
    return state_from(Json::parse(text));
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: is no restart file of dchmd hardspheres: {}", path, error.what()));
  } catch (const Json::exception& error) {
    throw FileError(fmt::format("{}: is no restart file of dchmd hardspheres: {}", path, error.what()));
  }
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
//
// dch_reference_forces SCENE ANSWERS: forces and energy of one configuration, which `compare` writes as JSON,
// by a plain loop over our neighbor list and by our kernels on cluster pairs. Units are those of the
// configuration.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/forces/lennard_jones.hpp>

#include "program.hpp"

namespace dch::bench {
namespace {

constexpr double kSkin = 0.02;  // of the cutoff, small for small boxes; forces do not depend on it

struct Scene {
  std::vector<Vec3> positions;
  Box box;
  double cutoff = 0;
  std::vector<LennardJonesPair> matrix;  // kinds x kinds
  std::vector<std::int32_t> kind;        // by particle
  std::vector<double> charges;           // by particle; empty if none acts
  CoulombTerm coulomb;
  Exclusions exclusions;

  int kinds() const { return static_cast<int>(std::lround(std::sqrt(static_cast<double>(matrix.size())))); }
  ListParams request() const {
    ListParams params;
    params.cutoffs = TypeCutoffs(kinds(), std::vector<double>(matrix.size(), cutoff));
    params.types = kind;
    params.skin = kSkin * cutoff;
    params.exclusions = &exclusions;
    return params;
  }
};

struct Answer {
  std::string name;
  std::vector<Vec3> forces;
  double energy = 0;
};

Vec3 vec3_of(const nlohmann::json& json) { return {json.at(0), json.at(1), json.at(2)}; }

/// Kinds mix by the rules of Lorentz and Berthelot.
std::vector<LennardJonesPair> mixed(const nlohmann::json& kinds, double cutoff) {
  std::vector<LennardJonesPair> matrix;
  for (const auto& a : kinds)
    for (const auto& b : kinds)
      matrix.push_back({std::sqrt(a.at("epsilon").get<double>() * b.at("epsilon").get<double>()),
                        0.5 * (a.at("sigma").get<double>() + b.at("sigma").get<double>()), cutoff});
  return matrix;
}

std::vector<IndexPair> pairs_within_molecules(std::int32_t particles, std::int32_t size) {
  std::vector<IndexPair> pairs;
  for (std::int32_t i = 0; i < particles; ++i)
    for (std::int32_t j = i - i % size; j < i; ++j) pairs.push_back({j, i});
  return pairs;
}

Scene read_scene(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(path + ": cannot be read");
  const nlohmann::json json = nlohmann::json::parse(file);
  Scene scene;
  for (const auto& p : json.at("positions")) scene.positions.push_back(vec3_of(p));
  const auto& v = json.at("vectors");
  scene.box = Box::triclinic(vec3_of(v.at(0)), vec3_of(v.at(1)), vec3_of(v.at(2)));
  scene.cutoff = json.at("cutoff");
  scene.kind = json.at("kind").get<std::vector<std::int32_t>>();
  scene.matrix = mixed(json.at("kinds"), scene.cutoff);
  const auto count = static_cast<std::int32_t>(scene.positions.size());
  scene.exclusions = Exclusions::from_pairs(scene.positions.size(),
                                            pairs_within_molecules(count, json.at("atoms_per_molecule")));
  if (!json.contains("field")) return scene;
  for (const std::int32_t kind : scene.kind)
    scene.charges.push_back(json.at("kinds").at(static_cast<std::size_t>(kind)).at("charge"));
  scene.coulomb.constant = json.at("constant");
  scene.coulomb.cutoffs.assign(scene.matrix.size(), scene.cutoff);
  scene.coulomb.quadratic = json.at("field").at(0);
  scene.coulomb.offset = json.at("field").at(1);
  return scene;
}

/// Adds what the pair does to both; d leads from i to j.
void add_pair(const Scene& scene, std::size_t i, std::size_t j, Vec3 d, Answer& answer) {
  const double r2 = norm2(d);
  if (r2 >= scene.cutoff * scene.cutoff) return;
  const auto kinds = static_cast<std::size_t>(scene.kinds());
  const LennardJonesPair& pair =
      scene.matrix[static_cast<std::size_t>(scene.kind[i]) * kinds + static_cast<std::size_t>(scene.kind[j])];
  const double s2 = pair.sigma * pair.sigma / r2, s6 = s2 * s2 * s2;
  double force_over_r = 24 * pair.epsilon * (2 * s6 * s6 - s6) / r2;
  answer.energy += 4 * pair.epsilon * (s6 * s6 - s6);
  if (!scene.charges.empty()) {
    const double qq = scene.coulomb.constant * scene.charges[i] * scene.charges[j], r = std::sqrt(r2);
    force_over_r += qq * (1 / (r * r2) - 2 * scene.coulomb.quadratic);
    answer.energy += qq * (1 / r + scene.coulomb.quadratic * r2 - scene.coulomb.offset);
  }
  answer.forces[j] = answer.forces[j] + force_over_r * d;
  answer.forces[i] = answer.forces[i] - force_over_r * d;
}

Answer by_list(const Scene& scene) {
  Answer answer{"neighbor list, plain loop", std::vector<Vec3>(scene.positions.size()), 0};
  const ListParams request = scene.request();
  HierarchyParams params;
  params.radius = request.list_radius();
  const auto search = make_dch_search(params);
  search->update(scene.positions, scene.box);
  const NeighborList list = search->list(request);
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t other : list.row(i)) {
      const auto j = static_cast<std::size_t>(other);
      add_pair(scene, i, j, scene.box.nearest_image(scene.positions[j] - scene.positions[i]), answer);
    }
  return answer;
}

Answer by_clusters(const Scene& scene, ForcePrecision precision) {
  const char* name =
      precision == ForcePrecision::double_precision ? "cluster pairs, double" : "cluster pairs, mixed";
  Answer answer{name, std::vector<Vec3>(scene.positions.size()), 0};
  const ListParams request = scene.request();
  HierarchyParams params;
  params.radius = request.list_radius();
  const auto search = make_dch_search(params);
  search->update(scene.positions, scene.box);
  ClusterPairs pairs;
  search->cluster_pairs(request, pairs);
  LennardJones potential(scene.kinds(), scene.matrix);
  if (!scene.charges.empty()) potential.set_coulomb(scene.coulomb);
  const LennardJonesSums sums = potential.add_forces_and_sum(pairs, precision, answer.forces, scene.charges);
  answer.energy = sums.energy + sums.coulomb_energy;
  return answer;
}

void write_answers(const std::string& path, const std::vector<Answer>& answers) {
  nlohmann::json json = nlohmann::json::array();
  for (const Answer& answer : answers) {
    nlohmann::json forces = nlohmann::json::array();
    for (const Vec3 f : answer.forces) forces.push_back({f.x, f.y, f.z});
    json.push_back({{"name", answer.name}, {"energy", answer.energy}, {"forces", std::move(forces)}});
  }
  std::ofstream file(path);
  file << json << '\n';
  if (!file.flush()) throw Error(path + ": cannot be written");
}

int run(const std::string& from, const std::string& to) {
  const Scene scene = read_scene(from);
  write_answers(to, {by_list(scene), by_clusters(scene, ForcePrecision::double_precision),
                     by_clusters(scene, ForcePrecision::mixed)});
  return kOk;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Forces and energy of one configuration, for a comparison with other programs",
               "dch_reference_forces");
  std::string from, to;
  app.add_option("SCENE", from, "File with the configuration, in JSON")->required();
  app.add_option("ANSWERS", to, "File to write, in JSON")->required();
  return run_program(app, argc, argv, [&] { return run(from, to); });
}

}  // namespace
}  // namespace dch::bench

int main(int argc, char** argv) { return dch::bench::parse_and_run(argc, argv); }

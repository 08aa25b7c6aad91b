// SPDX-License-Identifier: MIT
// Contact queries of one chain by each structure of the library.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

#include <dch/base/error.hpp>
#include <dch/necklace/melt.hpp>
#include <dch/necklace/walks.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "contenders.hpp"
#include "parts.hpp"
#include "stopwatch.hpp"

namespace dch::bench {

namespace {

using necklace::Shape;

/// The beads of a shape and, for the second frame, each a little elsewhere, by at most 0.01 along each axis:
/// as far as Langevin dynamics takes a bead in one step.
QueryScene scene_of(const char* name, const Shape& shape, double radius, double gap, bool yes_or_no) {
  QueryScene scene{name, {shape.positions, shape.positions}, radius, gap, yes_or_no};
  for (std::size_t k = 0; k < scene.frames[1].size(); ++k) {
    const auto phase = static_cast<double>(k);
    const Vec3 step{std::sin(7 * phase), std::sin(11 * phase), std::sin(13 * phase)};
    scene.frames[1][k] = scene.frames[1][k] + 0.01 * step;
  }
  return scene;
}

/// Which contacts they are, whatever their order: the sum of (i n + j)^2 modulo 2^64.
std::uint64_t checksum(const std::vector<IndexPair>& pairs, std::size_t beads) {
  std::uint64_t sum = 0;
  for (const auto& [i, j] : pairs) {
    const std::uint64_t key = static_cast<std::uint64_t>(i) * beads + static_cast<std::uint64_t>(j);
    sum += key * key;
  }
  return sum;
}

/// The contacts of the second frame, about which all contenders agree.
std::vector<IndexPair> agreed_contacts(const QueryScene& scene,
                                       std::vector<std::unique_ptr<Contender>>& contenders) {
  std::vector<IndexPair> expected;
  for (const auto& frame : scene.frames) {
    expected.clear();
    for (const auto& contender : contenders) {
      contender->update(frame);
      auto found = contender->lists() ? contender->contacts() : expected;
      std::sort(found.begin(), found.end());
      if (contender == contenders.front()) expected = found;
      require_same(found == expected, fmt::format("contacts of {} by {} and {}", scene.name,
                                                  contender->name(), contenders.front()->name()));
      const auto count = static_cast<std::int64_t>(expected.size());
      require_same(contender->ask() == (scene.yes_or_no ? std::min<std::int64_t>(count, 1) : count),
                   fmt::format("the answer of {} and its contacts", contender->name()));
    }
  }
  return expected;
}

struct Times {
  std::vector<double> update, query, both;  ///< [ms]
};

/// Contenders take turns, and the chain goes to and fro between its two frames.
std::vector<Times> time_all(const QueryScene& scene, std::vector<std::unique_ptr<Contender>>& contenders,
                            int rounds) {
  std::vector<Times> times(contenders.size());
  const Clock clock = scene.executor != nullptr ? Clock::wall : Clock::thread;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < contenders.size(); ++k) {
      Contender& contender = *contenders[k];
      const double update = seconds_of([&] { contender.update(scene.frames[round % 2]); }, clock);
      const double query = seconds_of([&] { contender.ask(); }, clock);
      times[k].update.push_back(1e3 * update);
      times[k].query.push_back(1e3 * query);
      times[k].both.push_back(1e3 * (update + query));
    }
  }
  return times;
}

/// How packed the chain is: cage pairs that a whole search compares, for each bead.
double visited_per_bead(const QueryScene& scene) {
  necklace::WrappedHierarchy hierarchy(scene.necklace());
  hierarchy.build(scene.frames[1], Box::none());
  necklace::ContactStats stats;
  find_contacts(hierarchy, scene.query(), &stats);
  return static_cast<double>(stats.cage_pairs) / static_cast<double>(scene.frames[1].size());
}

void measure_scene(const QueryScene& scene, int rounds, Table& table) {
  auto contenders = make_contenders(scene);
  const auto contacts = agreed_contacts(scene, contenders);
  const auto times = time_all(scene, contenders, rounds);
  const std::size_t beads = scene.frames[0].size();
  const double visited = visited_per_bead(scene);
  fmt::print("{}: {} beads, {} contacts, {:.2f} visited pairs a bead, {}\n", scene.name, beads,
             contacts.size(), visited, scene.yes_or_no ? "is there any?" : "all of them");
  fmt::print("  {:<18}{:>11}{:>11}{:>11}{:>15}\n", "[ms]", "update", "query", "both", "to cell list");
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double update = median_of(times[k].update), query = median_of(times[k].query);
    const double both = median_of(times[k].both);
    fmt::print("  {:<18}{:>11.3f}{:>11.3f}{:>11.3f}{:>15.3f}   {}\n", contenders[k]->name(), update, query,
               both, both / median_of(times[0].both), contenders[k]->note());
    table.push_back({{"scene", scene.name},
                     {"contender", contenders[k]->name()},
                     {"note", contenders[k]->note()},
                     {"question", scene.yes_or_no ? "any" : "all"},
                     {"beads", static_cast<double>(beads)},
                     {"visited_per_bead", visited},
                     {"reach", scene.reach()},
                     {"contacts", static_cast<double>(contacts.size())},
                     {"checksum", std::to_string(checksum(contacts, beads))},
                     {"update_ms", update},
                     {"query_ms", query},
                     {"both_ms", both}});
  }
}

void require_written(std::ofstream& out, const std::string& path) {
  if (!out.flush()) throw Error(path + ": cannot be written; check the folder and the free space");
}

void write_positions(const std::string& path, const std::vector<Vec3>& positions) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(positions.data()),
            static_cast<std::streamsize>(positions.size() * sizeof(Vec3)));
  require_written(out, path);
}

}  // namespace

Table measure_queries(int beads, int rounds, int threads, const std::string& folder) {
  const Shape swollen = necklace::self_avoiding_walk(beads, 1, 1);
  const Shape globule = necklace::globule(beads, 0.1, 1);
  // Radii without contact leave room for the steps.
  const Shape stretched = necklace::grid_necklace(beads, 1, 1);
  QueryScene scenes[] = {
      scene_of("stretched_apart", stretched, 0.47, 0, true),
      scene_of("swollen_apart", swollen, 0.47, 0, true), scene_of("swollen", swollen, 0.5, 0.3, false),
      scene_of("globule_apart", globule, 0.38, 0, true), scene_of("globule", globule, 0.5, 0.1, false)};
  const auto executor = threads > 1 ? make_thread_pool(threads) : nullptr;
  Table table;
  for (QueryScene& scene : scenes) {
    scene.executor = executor.get();
    measure_scene(scene, rounds, table);
    if (!folder.empty()) write_positions(folder + "/" + scene.name + ".positions", scene.frames[1]);
  }
  return table;
}

void write_chain(const std::string& path, int beads) {
  necklace::Melt chain;
  chain.positions = necklace::self_avoiding_walk(beads, 1, 1).positions;
  Vec3 low = chain.positions.front(), high = low;
  for (const Vec3& p : chain.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  // Room for the motion: the dynamics is periodic, and the chain should not meet its image.
  constexpr double kMargin = 20;
  const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) + 2 * kMargin;
  for (Vec3& p : chain.positions) p = p - low + Vec3{kMargin, kMargin, kMargin};
  chain.box = Box::orthorhombic({side, side, side});
  chain.images.resize(chain.positions.size());
  chain.molecules.assign(chain.positions.size(), 1);
  for (std::int32_t k = 0; k + 1 < beads; ++k) chain.bonds.push_back({k, k + 1});
  std::ofstream out(path);
  write_lammps_data(out, chain);
  require_written(out, path);
}

}  // namespace dch::bench

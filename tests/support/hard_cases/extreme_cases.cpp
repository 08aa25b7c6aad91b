// SPDX-License-Identifier: MIT
//
// Boxes, coordinates, radii and counts at the ends of what double precision and 32-bit indices hold.
#include <cmath>
#include <functional>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/lists/all_pairs.hpp>
#include <dch/lists/pair_list.hpp>
#include <dch/necklace/contact_finder.hpp>

#include "contact_oracle.hpp"
#include "hard_case.hpp"
#include "list_compare.hpp"
#include "list_params.hpp"
#include "listed_hierarchy.hpp"
#include "long_double_pairs.hpp"
#include "scenes.hpp"

namespace dch::hard {
namespace {

/// Edges that are powers of ten, ten or twenty decades apart.
Finding edges_of_any_size() {
  std::int64_t boxes = 0, refused = 0;
  PairComparison sum;
  for (int a = -100; a <= 100; a += 20)
    for (int b = -100; b <= 100; b += 10)
      for (int c = -100; c <= 100; c += 20) {
        try {
          ++boxes;
          const Box box = Box::orthorhombic({std::pow(10, a), std::pow(10, b), std::pow(10, c)});
          const auto points = scenes::uniform_in(box, 12, 1);
          const double radius = 0.9 * box.max_cutoff();
          const auto cells = make_cell_search(radius);
          cells->update(points, box);
          sum += compare_pairs(cells->list(within(radius)), points, box, radius);
        } catch (const Error&) {
          ++refused;
        }
      }
  return {std::to_string(boxes) + " boxes, " + std::to_string(refused) + " refused; " + sum.text(),
          sum.is_right() && sum.pairs > 0};
}

/// Both engines beside the library's all pairs, which start from the positions as given.
Finding as_all_pairs(const Box& box, double radius, double periods) {
  scenes::Random random(3);
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) {
    Vec3 p = box.origin() + random.in_ball(3 * radius);
    for (int axis = 0; axis < 3; ++axis)
      p = p + std::nearbyint(random.uniform(-periods, periods)) * box.vector(axis);
    points.push_back(p);
  }
  const NeighborList expected = all_pairs(points, box, within(radius));
  const auto cells = make_cell_search(radius), hierarchy = make_dch_search(radius);
  for (const auto& search : {cells.get(), hierarchy.get()}) {
    search->update(points, box);
    const std::string difference = first_difference(search->list(within(radius)), expected);
    if (!difference.empty()) return {search->name() + ": " + difference, false};
  }
  return {std::to_string(expected.pairs()) + " pairs, the same list", true};
}

/// Repairs while points are many periods away and when they are back.
Finding back_from_far_away() {
  const Box box = Box::orthorhombic({10, 10, 10});
  StructureParams params;
  params.radius = 1;
  params.base_radius = 0.3;
  params.policy = MaintenancePolicy::always_repair;
  ListedHierarchy hierarchy(params);
  scenes::Random random(5);
  std::vector<Vec3> points = scenes::uniform_in(box, 200, 6);
  hierarchy.build(points, box);
  for (const double periods : {1e12, 0.0, 1e11, 0.0}) {
    std::vector<Vec3> moved;
    for (Vec3& p : points) {
      p = p + random.in_ball(0.02);
      moved.push_back({p.x + 10 * std::nearbyint(random.uniform(-periods, periods)), p.y, p.z});
    }
    hierarchy.update(moved, box);
    if (const std::string violation = hierarchy.validate(); !violation.empty()) return {violation, false};
  }
  return {"valid after each of 4 repairs", true};
}

/// By the wrapped hierarchy and, after the first search, by the DCH as far as it takes them.
Finding beads_of(const std::vector<double>& radii) {
  scenes::Random random(7);
  std::vector<Vec3> positions(radii.size());
  for (Vec3& p : positions) p = random.in_ball(2);
  positions[7] = positions[30];
  std::size_t contacts = 0;
  for (const double gap : {0.0, 0.4}) {
    const necklace::ContactQuery query{gap, 0, true, true};
    necklace::ContactFinderParams params;
    params.to_dch = params.to_wrapped = 0;
    necklace::ContactFinder finder(necklace::Necklace::chain(radii), params);
    finder.update(positions, Box::none());
    finder.find_contacts(query);
    const auto found = test::pairs_of(finder.find_contacts(query));
    if (found != test::contact_oracle(finder.necklace(), positions, Box::none(), query))
      return {"other contacts for a gap of " + three_digits(gap), false};
    contacts += found.size();
  }
  return {std::to_string(contacts) + " contacts, the same", contacts > 0};
}

/// Chains whose cages stick out of each other; the certificate names cages that are apart in every image.
Finding cages_in_every_image() {
  int pairs = 0;
  constexpr int kChains = 12000;
  for (int seed = 1; seed <= kChains; ++seed) {
    scenes::Random random(static_cast<std::uint64_t>(seed));
    std::vector<Vec3> positions;
    Vec3 at{};
    for (int k = 0; k < 8; ++k) {
      positions.push_back(at);
      at = at + random.in_ball(2.9) + (k == 3 ? random.in_ball(3) : Vec3{});
    }
    necklace::Chains chains(8);
    chains.add(std::vector<std::int32_t>{0, 1, 2, 3});
    chains.add(std::vector<std::int32_t>{4, 5, 6, 7});
    necklace::WrappedHierarchy wrapped(necklace::Necklace(chains, 0.02),
                                       {1, necklace::Verification::cascade});
    wrapped.build(positions, Box::orthorhombic({6, 6, 6}));
    const necklace::ContactQuery query;
    const auto separation = necklace::separate(wrapped, query);
    const std::string wrong = necklace::check_certificate(wrapped, query, separation);
    if (!wrong.empty()) return {"chains " + std::to_string(seed) + ": " + wrong, false};
    pairs += static_cast<int>(separation.pairs.size());
  }
  return {std::to_string(kChains) + " certificates of " + std::to_string(pairs) + " pairs hold", true};
}

/// Passes if the call throws an Error whose message holds the part.
Case refused(const std::string& name, const std::string& part, std::function<void()> call) {
  return {"extremes", name, "an error with \"" + part + "\"", [part, call] {
            try {
              call();
            } catch (const Error& error) {
              const std::string message = error.what();
              return Finding{message, message.find(part) != std::string::npos};
            }
            return Finding{"accepted", false};
          }};
}

std::vector<Case> refusals() {
  return {
      refused("a box of 1e-100 x 1 x 1e100", "places apart",
              [] {
                Box::orthorhombic({1e-100, 1, 1e100});
              }),
      refused("a cell that ten million images would have to be looked through for", "give a reduced cell",
              [] {
                Box::triclinic({1, 0, 0}, {1e4, 1, 0}, {0, 1e4, 1});
              }),
      refused("a cell of a denormal volume", "double precision holds it from",
              [] {
                Box::triclinic({1e-100, 0, 0}, {0, 1e-100, 0}, {0, 1e-100, 1e-109});
              }),
      refused("a box so far from the origin that rounding loses it", "shift the box",
              [] {
                const Box box = Box::orthorhombic({10, 10, 10}, {true, true, true}, {1e17, 0, 0});
                make_dch_search(1)->update(std::vector<Vec3>{{1e17, 0, 0}}, box);
              }),
      refused("leaves of a million periods", "leave it 0",
              [] {
                StructureParams params;
                params.radius = 0.4;
                params.base_radius = 1e6;
                ListedHierarchy hierarchy(params);
                hierarchy.build(std::vector<Vec3>{{0, 0, 0}}, Box::orthorhombic({1, 1e9, 1e9}));
              }),
      refused("chains over 2^31 particles", "2147483648 particles",
              [] { necklace::Chains{std::size_t{1} << 31}; }),
      refused("a pair in an image that 32-bit numbers do not count", "wrap the coordinates first",
              [] {
                NeighborList list;
                list.first = {0, 1, 1};
                list.j = {1};
                PairList pairs;
                make_pair_list(
                    list, 2, std::vector<Vec3>{{0, 0, 0}, {3e10, 0, 0}}, Box::orthorhombic({10, 10, 10}), {},
                    [](auto, auto) { return true; }, pairs);
              }),
  };
}

}  // namespace

std::vector<Case> extreme_cases() {
  std::vector<double> mixed(40, 1e-300);
  for (std::size_t k = 0; k < mixed.size(); k += 3) mixed[k] = 0.5;
  const std::string as_given = "the list of all pairs", contacts = "the contacts of all pairs";
  const Box skewed = Box::triclinic({10, 0, 0}, {10 / 3.0, 10, 0}, {-2.5, 10 / 7.0, 10});
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::string& expected, auto run) {
    cases.push_back({"extremes", name, expected, run});
  };
  add("boxes with edges of 1e-100 to 1e100", "all pairs in long double, or refused", edges_of_any_size);
  add("a box whose corner is at 1e12", as_given, [] {
    return as_all_pairs(Box::orthorhombic({9.1, 9.1, 9.1}, {true, true, true}, {1e12, -1e12, 1e12}), 1, 1e3);
  });
  add("coordinates of 1e13 cutoffs in a skewed cell", as_given,
      [skewed] { return as_all_pairs(skewed, 1e-2, 1e10); });
  add("coordinates of 1e16 cutoffs in a skewed cell", as_given,
      [skewed] { return as_all_pairs(skewed, 1e-4, 1e11); });
  add("points of a hierarchy back from 1e12 periods away", "valid", back_from_far_away);
  add("beads that are points", contacts, [] { return beads_of(std::vector<double>(40, 0.0)); });
  add("beads of 1e-300", contacts, [] { return beads_of(std::vector<double>(40, 1e-300)); });
  add("beads of 1e-300 among those of 0.5", contacts, [mixed] { return beads_of(mixed); });
  add("cages near each other in two images", "certificates that hold in every image", cages_in_every_image);
  for (const Case& one : refusals()) cases.push_back(one);
  return cases;
}

}  // namespace dch::hard

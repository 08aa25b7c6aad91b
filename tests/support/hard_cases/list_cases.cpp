// SPDX-License-Identifier: MIT
//
// Lists against all pairs in long double.
#include <cmath>
#include <limits>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>

#include "hard_case.hpp"
#include "list_compare.hpp"
#include "list_params.hpp"
#include "long_double_pairs.hpp"
#include "scenes.hpp"

namespace dch::hard {
namespace {

constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

struct Scene {
  std::vector<Vec3> points;
  Box box;
  double radius = 1;
};

/// The lists of the hierarchy and of the cell list, and what is wrong with either or with the hierarchy.
struct Lists {
  explicit Lists(const Scene& scene) {
    const auto dch = make_dch_search(scene.radius), cells = make_cell_search(scene.radius);
    for (const auto& search : {dch.get(), cells.get()}) search->update(scene.points, scene.box);
    list = dch->list(within(scene.radius));
    fault = malformation(list, scene.points.size());
    if (fault.empty()) fault = dch->validate();
    if (!fault.empty()) return;
    const std::string difference = first_difference(cells->list(within(scene.radius)), list);
    if (!difference.empty()) fault = "cell list: " + difference;
  }
  NeighborList list;
  std::string fault;
};

Finding lists_in(const std::vector<Scene>& scenes) {
  PairComparison sum;
  for (const Scene& scene : scenes) {
    const Lists made(scene);
    if (!made.fault.empty()) return {scene.box.description() + ": " + made.fault, false};
    sum += compare_pairs(made.list, scene.points, scene.box, scene.radius);
  }
  return {sum.text(), sum.is_right() && sum.pairs > 0};
}

/// The points of one name, in a box of each kind.
std::vector<Scene> in_all_boxes(const std::string& name, double radius) {
  std::vector<Scene> found;
  for (const scenes::NamedBox& box : scenes::all_boxes(5))
    for (const scenes::NamedPoints& set : scenes::hard_point_sets(box.box, 150, 0.5 * radius))
      if (set.name == name) found.push_back({set.points, box.box, radius});
  return found;
}

Finding in_smallest_boxes() {
  std::vector<Scene> found;
  for (const scenes::NamedBox& box : scenes::all_boxes(5)) {
    const double radius = box.box.max_cutoff();
    if (!box.box.any_periodic()) continue;
    for (const scenes::NamedPoints& set : scenes::hard_point_sets(box.box, 60, 0.5 * radius))
      found.push_back({set.points, box.box, radius});
  }
  return lists_in(found);
}

/// The same lattice in a cell that a thousand multiples of one vector have been added to.
Finding in_skewed_cells() {
  const Vec3 a{5, 0, 0}, b{1, 6, 0}, c{-2, 1, 5};
  std::vector<Scene> found;
  for (const double skew : {10.0, 100.0, 1000.0})
    for (const Box& box : {Box::triclinic(a, b + skew * a, c), Box::triclinic(a, b, c - skew * a)})
      found.push_back({scenes::uniform_in(Box::triclinic(a, b, c), 60, 7), box, 1.5});
  return lists_in(found);
}

/// Cells that are ever flatter: right, or refused since coordinates leave the place in the cell uncertain.
Finding in_flat_cells() {
  PairComparison sum;
  double flattest = 1, refused_from = 0;
  for (double height = 1e-1; height > 1e-13; height /= 10) {
    try {
      const Box box = Box::triclinic({1, 0, 0}, {0.3, 1, 0}, {0.2, 0.4, height});
      const Scene scene{scenes::uniform_in(box, 80, 8), box, 0.99 * box.max_cutoff()};
      const Lists made(scene);
      if (!made.fault.empty()) return {"height " + three_digits(height) + ": " + made.fault, false};
      sum += compare_pairs(made.list, scene.points, box, scene.radius);
      flattest = height;
    } catch (const Error&) {
      if (refused_from == 0) refused_from = height;
    }
  }
  return {sum.text() + "; right down to a height of " + three_digits(flattest) + ", refused from " +
              three_digits(refused_from),
          sum.is_right() && refused_from > 0 && refused_from < flattest};
}

/// Coordinates on a grain of 2^-20 in cells of whole numbers: shifts by a million cells are exact.
Finding a_million_boxes_away() {
  PairComparison sum;
  for (const Box& box : {Box::orthorhombic({6, 7, 8}), Box::triclinic({6, 0, 0}, {2, 7, 0}, {-1, 3, 8})}) {
    scenes::Random random(9);
    Scene near{{}, box, 1.5};
    for (int k = 0; k < 150; ++k) {
      const Vec3 f = random.in_cube(4);
      near.points.push_back({std::ldexp(std::round(std::ldexp(f.x, 20)), -20),
                             std::ldexp(std::round(std::ldexp(f.y, 20)), -20),
                             std::ldexp(std::round(std::ldexp(f.z, 20)), -20)});
    }
    Scene far = near;
    for (Vec3& p : far.points)
      for (int axis = 0; axis < 3; ++axis)
        p = p + std::nearbyint(random.uniform(-1e6, 1e6)) * box.vector(axis);
    const Lists here(near), there(far);
    const std::string difference = first_difference(there.list, here.list);
    if (!here.fault.empty() || !there.fault.empty()) return {here.fault + there.fault, false};
    if (!difference.empty()) return {"far from the box " + difference, false};
    sum += compare_pairs(there.list, far.points, box, far.radius);
  }
  return {sum.text() + "; the same list as in the box", sum.is_right() && sum.pairs > 0};
}

/// Simple cubic sites: distances are whole numbers and exact.
Finding ties_at_the_radius() {
  Scene scene{{}, Box::orthorhombic({5, 5, 5}), 1};
  for (int k = 0; k < 125; ++k) scene.points.push_back({double(k % 5), double(k / 5 % 5), double(k / 25)});
  const Lists at(scene);
  scene.radius = std::nextafter(1.0, 0.0);
  const Lists below(scene);
  const std::int64_t within_one = at.list.pairs(), within_less = below.list.pairs();
  return {
      std::to_string(within_one) + " and " + std::to_string(within_less) + " pairs" + at.fault + below.fault,
      within_one == 375 && within_less == 0 && at.fault.empty() && below.fault.empty()};
}

Finding denormals() {
  std::vector<Scene> found;
  for (const auto& [box, radius] :
       {std::pair{Box::none(), 1.0}, {Box::none(), 1e-30}, {Box::orthorhombic({5, 5, 5}), 1.0}}) {
    Scene scene{{}, box, radius};
    for (const double x : {0.0, -0.0, kDenormal, -kDenormal, 1e-310, -1e-310, 2.3e-308})
      for (const double y : {0.0, -kDenormal, 1e-320}) scene.points.push_back({x, y, -x});
    found.push_back(scene);
  }
  Finding finding = lists_in(found);
  finding.passed = finding.passed && finding.found == "630 pairs, 0 missing, 0 too many";
  return finding;
}

/// Lengths in another unit.
Finding in_units_of(double unit) {
  std::vector<Scene> found;
  for (const scenes::NamedBox& named : scenes::all_boxes(5)) {
    const Box& b = named.box;
    const Box scaled = b.any_periodic()
                           ? Box::triclinic(unit * b.vector(0), unit * b.vector(1), unit * b.vector(2),
                                            {b.periodic(0), b.periodic(1), b.periodic(2)}, unit * b.origin())
                           : b;
    Scene scene{scenes::uniform_in(b, 150, 10), scaled, unit};
    for (Vec3& p : scene.points) p = unit * p;
    found.push_back(scene);
  }
  return lists_in(found);
}

}  // namespace

std::vector<Case> list_cases() {
  const std::string all = "all pairs in long double";
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const std::string& expected, auto run) {
    cases.push_back({"lists", name, expected, run});
  };
  const auto in_boxes = [&](const std::string& name, const std::string& points) {
    add(name, all, [points] { return lists_in(in_all_boxes(points, 0.9)); });
  };
  in_boxes("on faces, edges and corners, at -1e-17, 1,000 boxes away", "on the boundary");
  in_boxes("coincident atoms", "coincident");
  in_boxes("one atom at 1e12", "one far point");
  in_boxes("collinear atoms", "collinear");
  in_boxes("face-centered cubic, all distances tied", "fcc");
  in_boxes("densities that differ by nine decades", "clustered");
  add("distance exactly the list radius, and one rounding step more", "375 and 0 pairs", ties_at_the_radius);
  add("boxes exactly twice the list radius", all, in_smallest_boxes);
  add("cells skewed by up to 1,000 vectors", all, in_skewed_cells);
  add("nearly degenerate cells", all + ", or refused", in_flat_cells);
  add("coordinates of 1e6 boxes", all + ", and the list in the box", a_million_boxes_away);
  add("denormal coordinates", "all 210 pairs in each of 3 scenes", denormals);
  for (const double unit : {1e-10, 1e10, 1e-30, 1e29})
    add("lengths times " + three_digits(unit), all, [unit] { return in_units_of(unit); });
  return cases;
}

}  // namespace dch::hard

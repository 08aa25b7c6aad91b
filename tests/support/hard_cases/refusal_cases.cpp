// SPDX-License-Identifier: MIT
//
// Input that has no right answer: a clear error that names the value.
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

#include <dch/base/error.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#include "hard_case.hpp"
#include "listed_hierarchy.hpp"
#include "scenes.hpp"
#include "special_numbers.hpp"

namespace dch::hard {
namespace {

/// Passes if the call throws an Error whose message holds the part.
Case refused(const std::string& name, const std::string& part, std::function<void()> call) {
  return {"refusals", name, "an error with \"" + part + "\"", [part, call] {
            try {
              call();
            } catch (const Error& error) {
              const std::string message = error.what();
              return Finding{message, message.find(part) != std::string::npos};
            }
            return Finding{"accepted", false};
          }};
}

/// Both engines are given these positions, and both have to refuse them or neither; after a refusal they have
/// to hold nothing, and then to work again.
void update_both(const std::vector<Vec3>& points, const Box& box, double radius) {
  std::exception_ptr refusals[2];
  ListParams params;
  params.cutoffs = TypeCutoffs(radius);
  for (const bool hierarchy : {false, true}) {
    const auto search = hierarchy ? make_dch_search(radius) : make_cell_search(radius);
    try {
      search->update(points, box);
    } catch (const Error&) {
      refusals[hierarchy] = std::current_exception();
      if (search->list(params).size() != 0) throw std::logic_error("held something after a refusal");
      search->update(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}}, Box::none());
      if (search->list(params).pairs() != 1) throw std::logic_error("did not work after a refusal");
    }
  }
  if (!refusals[0] != !refusals[1]) throw std::logic_error("one engine refused, the other did not");
  if (refusals[1]) std::rethrow_exception(refusals[1]);
}

std::function<void()> with_point(Vec3 bad, const Box& box = Box::none()) {
  return [bad, box] {
    std::vector<Vec3> points = scenes::uniform(50, {5, 5, 5}, 1);
    points[20] = bad;
    update_both(points, box, 1);
  };
}

std::vector<Case> positions_and_radii() {
  const Box box = Box::orthorhombic({10, 10, 10});
  const std::vector<Vec3> two{{0, 0, 0}, {1, 0, 0}};
  const double beyond = std::nextafter(5.0, 6.0);
  return {
      refused("a coordinate that is NaN", "position 20 = (1, nan, 2)", with_point({1, kNaN, 2})),
      refused("an infinite coordinate", "position 20 = (1, 2, -inf)", with_point({1, 2, -kInfinity})),
      refused("a coordinate beyond 1e100", "beyond 1e+100", with_point({1e101, 0, 0})),
      refused("a coordinate that rounding loses in the box", "wrap the coordinates first",
              with_point({0, 1e16, 0}, box)),
      refused("a list radius one rounding step beyond half the box", "exceeds 5, half the smallest height",
              [=] { update_both(two, box, beyond); }),
      refused("a list radius that is NaN", "radius (cutoff + skin) is nan", [] { make_dch_search(kNaN); }),
      refused("a list radius of 1e-31", "radius (cutoff + skin) is 1e-31", [] { make_dch_search(1e-31); }),
      refused("a list radius of 1e31", "radius (cutoff + skin) is 1e+31", [] { make_dch_search(1e31); }),
      refused("a denormal radius of cells", "search radius is 1e-310", [] { make_cell_search(1e-310); }),
      refused("cluster pairs in single precision at a list radius of 1e-10", "outside 1e-9..1e9",
              [=] {
                StructureParams params;
                params.radius = 1e-10;
                ListedHierarchy h(params);
                h.build(two, Box::none());
                ListParams list;
                list.cutoffs = TypeCutoffs(1e-10);
                ClusterPairs pairs;
                h.cluster_pairs(list, pairs);
              }),
  };
}

std::vector<Case> cells_and_chains() {
  return {
      refused("a cell length that is NaN", "along y is nan long",
              [] {
                Box::orthorhombic({1, kNaN, 1});
              }),
      refused("a negative cell length", "along y is -2.5 long",
              [] {
                Box::orthorhombic({1, -2.5, 1});
              }),
      refused("a cell length of 1e-101", "between 1e-100 and 1e+100",
              [] {
                Box::orthorhombic({1, 1, 1e-101});
              }),
      refused("cell vectors in one plane", "linearly dependent",
              [] {
                Box::triclinic({1, 0, 0}, {0, 1, 0}, {1, 1, 0});
              }),
      refused("cell vectors in one plane but for 1e-13", "linearly dependent",
              [] {
                Box::triclinic({1, 0, 0}, {0, 1, 0}, {1, 1, 1e-13});
              }),
      refused("c = 1, where parent and child edges change together", "1.05",
              [] {
                StructureParams params;
                params.radius = 1;
                params.c = 1;
                Hierarchy{params};
              }),
      refused("a bead that is NaN", "nan",
              [] {
                necklace::WrappedHierarchy wrapped(necklace::Necklace::chain({1, 1}));
                wrapped.build(std::vector<Vec3>{{0, 0, 0}, {kNaN, 0, 0}}, Box::none());
              }),
  };
}

}  // namespace

std::vector<Case> refusal_cases() {
  std::vector<Case> cases = positions_and_radii();
  for (const Case& one : cells_and_chains()) cases.push_back(one);
  return cases;
}

}  // namespace dch::hard

// SPDX-License-Identifier: MIT
// Pairs over all images: at once, and followed from step to step.
#include <cmath>
#include <pybind11/stl.h>

#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/engines/pair_columns.hpp>
#include <dch/lists/stale_test.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "request.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

/// Bytes that a pair takes in the list and beside it while they are found.
constexpr double kListBytes = 24;
/// So many pairs no machine minds, so that its memory is not asked for.
constexpr std::int64_t kFewPairs = 1000000;

/// Calls find(params) for no more pairs than there is memory for.
template <class Find>
void find_in_memory(NeighborPairsParams params, std::size_t particles, double bytes_per_pair,
                    const Find& find) {
  constexpr std::size_t kFewParticles = 1000;
  if (particles <= kFewParticles) {
    params.max_pairs = kFewPairs;
    try {
      return find(params);
    } catch (const TooManyPairs&) {  // for the memory that every machine has
    }
  }
  params.max_pairs = static_cast<std::int64_t>(available_memory() / (kListBytes + bytes_per_pair));
  find(params);
}

/// Has `fill` fill new arrays: fill(columns) calls columns(pairs), and returns the number of pairs. The lock
/// of the interpreter is given up meanwhile.
template <class Fill>
py::tuple filled(const PairOutput& output, const Fill& fill) {
  std::optional<PairArrays> arrays;
  std::int64_t found = 0, room = 0;
  {
    const py::gil_scoped_release release;
    found = fill([&](std::int64_t pairs) {
      const py::gil_scoped_acquire lock;
      arrays.emplace(output, pairs);
      room = pairs;
      return arrays->columns();
    });
  }
  if (found < room) arrays->shorten(found);
  return arrays->tuple();
}

py::tuple find_pairs(const std::string& quantities, const Doubles& positions, const Doubles& cell,
                     std::array<bool, 3> periodic, Request& request, bool self_interaction, int threads,
                     bool single, std::optional<py::tuple> out) {
  const PairOutput output{quantities, single, std::move(out)};
  const Span<const Vec3> points = points_of(positions);
  const Box box = box_of(cell, periodic);
  Threads pool(threads);
  NeighborPairsParams params = request.pairs_of(points.size(), 0);
  params.executor = pool.executor();
  const std::vector<char> with_themselves =
      self_interaction ? request.with_themselves(points.size()) : std::vector<char>();
  return filled(output, [&](const MakeColumns& columns) {
    std::int64_t found = 0;
    find_in_memory(params, points.size(), output.bytes_per_pair(), [&](const NeighborPairsParams& limited) {
      found = neighbor_columns(points, box, limited, with_themselves, columns);
    });
    return found;
  });
}

/// Pairs found with a skin, which are followed until some might be missing.
class VerletPairs {
 public:
  VerletPairs(Request request, double skin, int threads)
      : request_(std::move(request)), skin_(skin), stale_test_(skin), threads_(threads) {}

  bool update(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "VerletList");
    const Span<const Vec3> points = points_of(positions);
    const Box box = box_of(cell, periodic);
    NeighborPairsParams params = request_.pairs_of(points.size(), skin_);
    params.executor = threads_.executor();
    const py::gil_scoped_release release;
    const bool is_new = is_stale(points, box);
    positions_.clear();  // until all has succeeded
    if (is_new) {
      stale_test_.forget();
      find_in_memory(params, points.size(), 0, [&](const NeighborPairsParams& limited) {
        neighbor_pairs(points, box, limited, pairs_);
      });
      const double cutoff =
          params.radii.empty() ? params.cutoffs.largest() : 2 * RadiusRange(params.radii).largest;
      stale_test_.remember(points, box, cutoff + skin_);
      ++rebuilds_;
    } else {
      pairs_.follow(points, box);
    }
    box_ = box;
    positions_.assign(points.begin(), points.end());
    return is_new;
  }

  py::tuple pairs(const std::string& quantities, bool with_skin, bool self_interaction, bool single,
                  std::optional<py::tuple> out) {
    const InUse in_use(used_, "VerletList");
    if (positions_.size() != pairs_.particles() || rebuilds_ == 0)
      throw InvalidParameter(
          "this VerletList has no positions yet, or the last update failed; call update()");
    const std::vector<char> with_themselves =
        self_interaction ? request_.with_themselves(positions_.size()) : std::vector<char>();
    const PairOutput output{quantities, single, std::move(out)};
    return filled(output, [&](const MakeColumns& columns) {
      return columns_of(pairs_, positions_,
                        with_skin ? NeighborPairs::Within::cutoff_and_skin : NeighborPairs::Within::cutoff,
                        with_themselves, threads_.executor(), columns);
    });
  }

  std::string text() const {
    return std::to_string(positions_.size()) + " particles, " + std::to_string(pairs_.listed()) +
           " pairs listed, " + std::to_string(rebuilds_) + " rebuilds";
  }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::size_t particles() const { return positions_.size(); }

 private:
  bool is_stale(Span<const Vec3> points, const Box& box) const {
    if (positions_.empty() || (box != box_ && !pairs_.may_change_box())) return true;
    return stale_test_.is_stale(points, box);
  }

  Request request_;
  double skin_;
  StaleTest stale_test_;
  Threads threads_;
  NeighborPairs pairs_;
  std::vector<Vec3> positions_;
  Box box_;
  std::int64_t rebuilds_ = 0;
  std::atomic<bool> used_{false};
};

}  // namespace

void bind_pairs(py::module_& m) {
  py::class_<Request>(m, "Request")
      .def(py::init<Doubles, std::optional<Ints>, std::optional<Doubles>, bool, std::optional<Ints>>(),
           py::arg("cutoffs").noconvert(), py::arg("types").noconvert(), py::arg("radii").noconvert(),
           py::arg("half"), py::arg("exclusions").noconvert() = py::none());
  m.def("find_pairs", &find_pairs, py::arg("quantities"), py::arg("positions").noconvert(),
        py::arg("cell").noconvert(), py::arg("pbc"), py::arg("request"), py::arg("self_interaction"),
        py::arg("threads"), py::arg("single"), py::arg("out"));
  py::class_<VerletPairs>(m, "VerletPairs")
      .def(py::init<Request, double, int>(), py::arg("request"), py::arg("skin"), py::arg("threads"))
      .def("update", &VerletPairs::update, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("pairs", &VerletPairs::pairs, py::arg("quantities"), py::arg("with_skin"),
           py::arg("self_interaction"), py::arg("single"), py::arg("out"))
      .def("text", &VerletPairs::text)
      .def_property_readonly("rebuilds", &VerletPairs::rebuilds)
      .def_property_readonly("particles", &VerletPairs::particles);
}

}  // namespace dch::python

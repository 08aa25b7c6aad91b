// SPDX-License-Identifier: MIT
// Lists in the form that the library has them, the oracle, and nearest neighbors.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <pybind11/stl.h>

#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/hierarchy/hierarchy.hpp>
#include <dch/lists/all_pairs.hpp>
#include <dch/proximity/nearest.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "request.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

ListKind kind_of(bool full) { return full ? ListKind::full : ListKind::half; }

py::tuple csr_of(NeighborList list) {
  auto owned = std::make_unique<NeighborList>(std::move(list));
  const NeighborList& rows = *owned;
  const py::capsule owner = owner_of(std::move(owned));  // one for both arrays takes less time than two
  py::array first = array_in(rows.first, owner);
  return py::make_tuple(std::move(first), array_in(rows.j, owner));
}

/// Rows as they lie in the structure, with the particle of each.
py::tuple unsorted_of(NeighborList list) {
  list.j.resize(static_cast<std::size_t>(list.first.back()));  // nothing behind the last row
  if (list.particle.empty()) {
    list.particle.resize(list.size());
    std::iota(list.particle.begin(), list.particle.end(), 0);
  }
  py::array particle = array_of(std::move(list.particle));
  py::tuple rows = csr_of(std::move(list));
  return py::make_tuple(std::move(particle), rows[0], rows[1]);
}

/// An engine over positions that change.
class Search {
 public:
  Search(Request request, int threads) : request_(std::move(request)), threads_(threads) {
    params_.radius = request_.cutoffs().largest();
    params_.size_classes = request_.has_types();
    params_.executor = threads_.executor();
    search_ = make_auto_search(params_);
  }

  void update(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "NeighborSearch");
    const Span<const Vec3> points = points_of(positions);
    const Box& box = box_.of(cell, periodic);
    if (Executor* const executor = threads_.executor();
        executor != params_.executor) {  // in a forked process
      params_.executor = executor;
      search_ = make_auto_search(params_);
    }
    particles_ = -1;
    const py::gil_scoped_release release;
    request_.check(points.size());
    search_->update(points, box);
    sampled_.clear();
    if (!fits_if_all_are_near(points.size(), bytes_per_pair(true), memory_))
      sampled_.assign(points.begin(), points.end());
    particles_ = static_cast<std::int64_t>(points.size());
  }

  /// The same for what a caller hands in, if it can be read as it is. @returns whether it can; else nothing
  /// is done
  bool update_as_given(py::handle positions, py::handle cell, py::handle periodic) {
    const bool is_open = periodic.ptr() == Py_False;
    if (!is_open && periodic.ptr() != Py_True && !periodic.is_none()) return false;
    if (!is_plain(positions, -1) || !is_plain(cell, 3)) return false;
    const auto vectors = py::reinterpret_borrow<Doubles>(cell);
    if (!are_finite(vectors)) return false;
    update(py::reinterpret_borrow<Doubles>(positions), vectors, {!is_open, !is_open, !is_open});
    return true;
  }

  py::tuple csr(bool full) { return csr_of(list(full, RowOrder::by_index)); }
  py::tuple unsorted(bool full) { return unsorted_of(list(full, RowOrder::unsorted)); }

  std::int64_t particles() const { return std::max<std::int64_t>(particles_, 0); }

 private:
  static constexpr double kRowBytes = 12;  // of indices, and what rows are made of

  static double bytes_per_pair(bool full) { return full ? kRowBytes : 0.5 * kRowBytes; }

  /// @throws NotEnoughMemory if there is not enough for a list.
  void check_list(bool full) {
    const auto n = static_cast<std::size_t>(particles_);
    if (sampled_.empty() || fits_if_all_are_near(n, bytes_per_pair(full))) return;
    NeighborPairsParams params = request_.pairs_of(n, 0);
    params.kind = kind_of(full);
    check_memory(expected_pairs(sampled_, box_.last(), params), kRowBytes, "pairs", "take a smaller cutoff");
  }

  NeighborList list(bool full, RowOrder order) {
    const InUse in_use(used_, "NeighborSearch");
    if (particles_ < 0)
      throw InvalidParameter(
          "this NeighborSearch has no positions yet, or the last update failed; call update()");
    check_list(full);
    NeighborList list;
    const py::gil_scoped_release release;
    ListParams params = request_.list_of(static_cast<std::size_t>(particles_), kind_of(full));
    params.order = order;
    search_->list(params, list);
    return list;
  }

  Request request_;
  Threads threads_;
  HierarchyParams params_;
  std::unique_ptr<PairSearch> search_;
  std::int64_t particles_ = -1;
  std::vector<Vec3> sampled_;  ///< positions, where a list of all pairs might not fit into memory
  LastBox box_;
  RecentMemory memory_;
  std::atomic<bool> used_{false};
};

py::tuple all_pairs_of(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic,
                       Request& request, bool full) {
  const Span<const Vec3> points = points_of(positions);
  const Box box = box_of(cell, periodic);
  NeighborList list;
  {
    const py::gil_scoped_release release;
    list = all_pairs(points, box, request.list_of(points.size(), kind_of(full)));
  }
  return csr_of(std::move(list));
}

/// About the distance of the k-th neighbor if the points fill their surroundings evenly; any radius is right.
double usual_distance(Span<const Vec3> points, const Box& box, std::int32_t k) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double widest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const double wanted =
      0.62 * widest * std::cbrt(static_cast<double>(k) / static_cast<double>(points.size()));
  return std::clamp(std::isfinite(wanted) && wanted > 0 ? std::min(wanted, box.max_cutoff()) : 1,
                    kMinListRadius, std::min(kMaxListRadius, box.max_cutoff()));
}

NearestRows nearest_rows(Span<const Vec3> points, const Box& box,
                         const std::optional<Span<const Vec3>>& queries, const NearestParams& params) {
  HierarchyParams hierarchy_params;
  hierarchy_params.radius = points.empty() ? kMinListRadius : usual_distance(points, box, params.k);
  hierarchy_params.executor = params.executor;
  Hierarchy hierarchy(hierarchy_params);
  hierarchy.build(points, box);
  const Nearest nearest(hierarchy.view());
  NearestRows rows = queries ? nearest.of_positions(*queries, params) : nearest.of_points(params);
  for (double& d : rows.distance2) d = std::sqrt(d);
  return rows;
}

py::tuple find_nearest(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic,
                       const std::optional<Doubles>& queries, std::int32_t k, double epsilon, int threads) {
  const Span<const Vec3> points = points_of(positions);
  std::optional<Span<const Vec3>> asked;
  if (queries) asked = points_of(*queries);
  const Box box = box_of(cell, periodic);
  check_memory(static_cast<double>(asked ? asked->size() : points.size()) * k,
               sizeof(std::int32_t) + sizeof(double), "neighbors",
               "take a smaller k, or fewer queries at once");
  Threads pool(threads);
  NearestRows rows;
  {
    const py::gil_scoped_release release;
    rows = nearest_rows(points, box, asked, {k, epsilon, pool.executor()});
  }
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size()), k};
  py::array index = array_of(std::move(rows.id), shape);
  return py::make_tuple(std::move(index), array_of(std::move(rows.distance2), shape));
}

}  // namespace

void bind_queries(py::module_& m) {
  py::class_<Search>(m, "Search")
      .def(py::init<Request, int>(), py::arg("request"), py::arg("threads"))
      .def("update", &Search::update, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("update_as_given", &Search::update_as_given, py::arg("positions"), py::arg("cell"), py::arg("pbc"))
      .def("csr", &Search::csr, py::arg("full"))
      .def("unsorted", &Search::unsorted, py::arg("full"))
      .def_property_readonly("particles", &Search::particles);
  m.def("all_pairs", &all_pairs_of, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
        py::arg("pbc"), py::arg("request"), py::arg("full"));
  m.def("nearest", &find_nearest, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
        py::arg("pbc"), py::arg("queries").noconvert(), py::arg("k"), py::arg("epsilon"), py::arg("threads"));
}

}  // namespace dch::python

// SPDX-License-Identifier: MIT
// The hierarchy itself: its levels, parents and edges.
#include <algorithm>
#include <pybind11/stl.h>

#include <dch/base/error.hpp>
#include <dch/hierarchy/hierarchy.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

/// Bytes that a point takes in the structure while it is made.
constexpr double kPointBytes = 400;
constexpr const char* kRemedy = "take a smaller radius, or fewer points";

/// Pairs of ids of which nobody knows how many there will be: memory is asked for before it grows.
class EdgeList {
 public:
  void add(std::int32_t a, std::int32_t b) {
    if (ids_.size() == ids_.capacity()) grow();
    ids_.insert(ids_.end(), {a, b});
  }
  std::vector<std::int32_t> take() { return std::move(ids_); }

 private:
  void grow() {
    const std::size_t size = std::max<std::size_t>(2 * ids_.capacity(), 1024);
    check_memory(static_cast<double>(size) / 2, 2 * sizeof(std::int32_t), "edges", kRemedy);
    ids_.reserve(size);
  }

  std::vector<std::int32_t> ids_;
};

class Levels {
 public:
  Levels(double radius, int threads) : threads_(threads), hierarchy_(params(radius)) {}

  void update(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "Hierarchy");
    const Span<const Vec3> points = points_of(positions);
    const Box box = box_of(cell, periodic);
    const py::gil_scoped_release release;
    if (points.size() > hierarchy_.size())
      check_memory(static_cast<double>(points.size() - hierarchy_.size()), kPointBytes, "points", kRemedy);
    const bool was_whole = whole_;
    whole_ = false;
    if (was_whole && points.size() == hierarchy_.size())
      hierarchy_.update(points, box);
    else
      hierarchy_.build(points, box);
    hierarchy_.repair();
    whole_ = true;
  }

  int levels() {
    const InUse in_use(used_, "Hierarchy");
    return view().levels();
  }
  std::size_t particles() const { return whole_ ? hierarchy_.size() : 0; }

  /// Nodes, parents, edges, covering radius and edge threshold.
  py::tuple level(int number) {
    const InUse in_use(used_, "Hierarchy");
    const HierarchyView all = view();
    if (number < 0 || number >= all.levels())
      throw InvalidParameter("level is " + std::to_string(number) + ", and there are " +
                             std::to_string(all.levels()) + "; give one of them, from 0 on");
    std::vector<std::int32_t> nodes, parents;
    EdgeList edge_list;
    {
      const py::gil_scoped_release release;
      check_edges(all, number);
      const auto end = static_cast<std::int32_t>(all.capacity());
      for (std::int32_t id = 0; id < end; ++id)
        if (all.top_level(id) >= number) {
          nodes.push_back(id);
          parents.push_back(all.parent(id, number));
          for (const std::int32_t other : all.neighbors(id, number))
            if (other > id) edge_list.add(id, other);
        }
    }
    const LevelInfo info = all.level(number);
    std::vector<std::int32_t> edges = edge_list.take();
    py::array ids = array_of(std::move(nodes)), above = array_of(std::move(parents));
    const auto pairs = static_cast<py::ssize_t>(edges.size() / 2);
    return py::make_tuple(std::move(ids), std::move(above), array_of(std::move(edges), {pairs, 2}),
                          info.covering_radius, info.edge_threshold);
  }

 private:
  /// By some nodes, so that nobody waits for what does not fit. Only the edges of level 0 may be many.
  static void check_edges(const HierarchyView& all, int number) {
    constexpr std::int32_t kSampled = 8;
    const auto end = static_cast<std::int32_t>(all.capacity());
    if (number > 0 || end == 0) return;
    const std::int32_t sampled = std::min(kSampled, end);
    double found = 0;
    for (std::int64_t k = 0; k < sampled; ++k)
      found += static_cast<double>(all.neighbors(static_cast<std::int32_t>(k * end / sampled), 0).size());
    check_memory(0.5 * found / sampled * end, 2 * sizeof(std::int32_t), "edges", kRemedy);
  }

  HierarchyParams params(double radius) {
    HierarchyParams params;
    params.radius = radius;
    params.executor = &threads_;
    return params;
  }
  HierarchyView view() {
    if (!whole_)
      throw InvalidParameter("this Hierarchy has no positions yet, or the last update failed; call update()");
    return hierarchy_.view();
  }

  PresentThreads threads_;
  Hierarchy hierarchy_;
  bool whole_ = false;
  std::atomic<bool> used_{false};
};

}  // namespace

void bind_hierarchy(py::module_& m) {
  py::class_<Levels>(m, "Levels")
      .def(py::init<double, int>(), py::arg("radius"), py::arg("threads"))
      .def("update", &Levels::update, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("levels", &Levels::levels)
      .def("level", &Levels::level, py::arg("number"))
      .def_property_readonly("particles", &Levels::particles);
}

}  // namespace dch::python

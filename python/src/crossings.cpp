// SPDX-License-Identifier: MIT
// Bonds that go through each other from one frame to the next.
#include <pybind11/stl.h>

#include <dch/base/error.hpp>
#include <dch/necklace/crossings.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "rows.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

using necklace::CrossingFinder;
using necklace::StepCrossings;
using necklace::UndeterminedBond;

/// What a step gave, with particles in the place of numbers of bonds.
class StepArrays {
 public:
  StepArrays(const StepCrossings& step, Span<const IndexPair> bonds) : step_(step), bonds_(bonds) {}

  py::tuple crossings() const {
    const auto& all = step_.crossings;
    return py::make_tuple(
        beads(all, [](const auto& event) { return event.p; }),
        beads(all, [](const auto& event) { return event.q; }),
        rows_of<double, 1>(all, [](const auto& event) { return std::array<double, 1>{event.time}; }),
        rows_of<double, 2>(all,
                           [](const auto& event) {
                             return std::array<double, 2>{event.on_p, event.on_q};
                           }),
        rows_of<double, 3>(all,
                           [](const auto& event) {
                             return std::array<double, 3>{event.place.x, event.place.y, event.place.z};
                           }),
        rows_of<std::int32_t, 1>(all,
                                 [](const auto& event) { return std::array<std::int32_t, 1>{event.sign}; }));
  }
  py::tuple contacts() const {
    const auto& all = step_.contacts;
    return py::make_tuple(
        beads(all, [](const auto& event) { return event.p; }),
        beads(all, [](const auto& event) { return event.q; }),
        rows_of<double, 1>(all, [](const auto& event) { return std::array<double, 1>{event.time}; }),
        rows_of<double, 1>(all, [](const auto& event) { return std::array<double, 1>{event.distance}; }));
  }
  /// The bonds, and of each 1 if it is too long, 0 if a bead of it moved too far.
  py::tuple undetermined() const {
    const auto& all = step_.undetermined;
    return py::make_tuple(beads(all, [](const UndeterminedBond& bond) { return bond.bond; }),
                          rows_of<std::uint8_t, 1>(all, [](const UndeterminedBond& bond) {
                            const bool too_long = bond.reason == UndeterminedBond::Reason::bond_too_long;
                            return std::array<std::uint8_t, 1>{too_long};
                          }));
  }

 private:
  template <class Events, class Bond>
  py::array beads(const Events& events, const Bond& bond) const {
    return rows_of<std::int32_t, 2>(
        events, [&](const auto& event) { return bonds_[static_cast<std::size_t>(bond(event))]; });
  }

  const StepCrossings& step_;
  Span<const IndexPair> bonds_;
};

/// The finder, and what it holds from step to step.
class CrossingSteps {
 public:
  CrossingSteps(std::size_t particles, const Ints& bonds, double thickness, int threads)
      : threads_(threads), finder_(particles, index_pairs_of(bonds), {thickness, &threads_}) {}

  void start(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "Crossings");
    const Span<const Vec3> points = points_of(positions);
    const Box box = box_of(cell, periodic);
    const py::gil_scoped_release release;
    finder_.start(points, box);
  }

  /// Crossings, contacts, undetermined bonds, and how many bonds were not there at the beginning.
  py::tuple step(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "Crossings");
    const Span<const Vec3> points = points_of(positions);
    const Box box = box_of(cell, periodic);
    const StepCrossings* found = nullptr;
    {
      const py::gil_scoped_release release;
      found = &finder_.step(points, box);
    }
    const StepArrays arrays(*found, finder_.bonds());
    return py::make_tuple(arrays.crossings(), arrays.contacts(), arrays.undetermined(), found->started);
  }

  void set_bonds(const Ints& bonds) {
    const InUse in_use(used_, "Crossings");
    finder_.set_bonds(index_pairs_of(bonds));
  }
  py::array bonds() const {
    const Span<const IndexPair> all = finder_.bonds();
    return rows_of<std::int32_t, 2>(all, [](const IndexPair& bond) { return bond; });
  }

 private:
  PresentThreads threads_;
  CrossingFinder finder_;
  std::atomic<bool> used_{false};
};

}  // namespace

void bind_crossings(py::module_& m) {
  py::class_<CrossingSteps>(m, "CrossingSteps")
      .def(py::init<std::size_t, const Ints&, double, int>(), py::arg("particles"),
           py::arg("bonds").noconvert(), py::arg("thickness"), py::arg("threads"))
      .def("start", &CrossingSteps::start, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("step", &CrossingSteps::step, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("set_bonds", &CrossingSteps::set_bonds, py::arg("bonds").noconvert())
      .def("bonds", &CrossingSteps::bonds);
}

}  // namespace dch::python

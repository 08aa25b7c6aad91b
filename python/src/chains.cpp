// SPDX-License-Identifier: MIT
// Chains of beads, and which beads are in contact.
#include <algorithm>
#include <pybind11/stl.h>

#include <dch/base/error.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/necklace/chains.hpp>
#include <dch/necklace/contact_finder.hpp>
#include <dch/necklace/contact_map.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/necklace.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "rows.hpp"
#include "threads.hpp"

namespace dch::python {
namespace {

using necklace::Chains;
using necklace::Contact;
using necklace::ContactFinder;
using necklace::ContactMap;
using necklace::ContactQuery;
using necklace::Necklace;

/// Chain k has the beads first[k] .. first[k + 1] - 1.
Chains chains_of_rows(std::size_t particles, const Ints& beads, const std::vector<std::int64_t>& first,
                      const std::vector<bool>& closed) {
  Chains chains(particles);
  for (std::size_t k = 0; k + 1 < first.size(); ++k)
    chains.add({beads.data() + first[k], static_cast<std::size_t>(first[k + 1] - first[k])}, closed[k]);
  return chains;
}

py::array beads_of(const Chains& chains, std::size_t chain) {
  const Span<const std::int32_t> beads = chains.beads(chain);
  return array_of(std::vector<std::int32_t>(beads.begin(), beads.end()));
}

py::array unwrapped(const Chains& chains, const Doubles& positions, const Doubles& cell,
                    std::array<bool, 3> periodic) {
  const std::vector<Vec3> places = unwrap(chains, points_of(positions), box_of(cell, periodic));
  return rows_of<double, 3>(places, [](Vec3 p) { return std::array<double, 3>{p.x, p.y, p.z}; });
}

/// One radius for all, or one each.
Necklace necklace_of(const Chains& chains, const Doubles& radii) {
  if (radii.ndim() == 0) return {chains, *radii.data()};
  return {chains, std::vector<double>(radii.data(), radii.data() + radii.size())};
}

py::tuple arrays_of(const std::vector<Contact>& contacts) {
  using Place = std::array<double, 3>;
  return py::make_tuple(rows_of<std::int32_t, 1>(contacts, [](const Contact& c) { return std::array{c.i}; }),
                        rows_of<std::int32_t, 1>(contacts, [](const Contact& c) { return std::array{c.j}; }),
                        rows_of<double, 1>(contacts, [](const Contact& c) { return std::array{c.gap}; }),
                        rows_of<double, 3>(contacts,
                                           [](const Contact& c) {
                                             return Place{c.on_i.x, c.on_i.y, c.on_i.z};
                                           }),
                        rows_of<double, 3>(contacts, [](const Contact& c) {
                          return Place{c.on_j.x, c.on_j.y, c.on_j.z};
                        }));
}

/// Bytes that a bead takes in the structures, and a contact while it is found and in the arrays.
constexpr double kBeadBytes = 600, kContactBytes = 2 * sizeof(Contact) + 24;

/// Radii by place, and half the gap with them, for which pairs of beads are near as far as contacts are.
std::vector<double> reaches_of(const Necklace& necklace, double gap) {
  std::vector<double> out;
  out.reserve(necklace.size());
  for (const std::int32_t bead : necklace.particle())
    out.push_back(std::max(necklace.radius(bead) + 0.5 * gap, kMinListRadius));
  return out;
}

/// The finder, and what it holds from frame to frame.
class Contacts {
 public:
  Contacts(const Chains& chains, const Doubles& radii, ContactQuery query, int threads)
      : threads_(threads), query_(query), finder_(checked(necklace_of(chains, radii)), params()) {}

  py::tuple find(const Doubles& positions, const Doubles& cell, std::array<bool, 3> periodic) {
    const InUse in_use(used_, "ContactFinder");
    const Span<const Vec3> points = points_of(positions);
    const Box box = box_of(cell, periodic);
    std::vector<Contact> found;
    {
      const py::gil_scoped_release release;
      finder_.update(points, box);
      check_contacts(points, box);
      found = finder_.find_contacts(query_);
    }
    return arrays_of(found);
  }

  /// "wrapped" or "dch", and why.
  py::tuple choice() const {
    const InUse in_use(used_, "ContactFinder");
    return py::make_tuple(name_of(finder_.choice().structure), finder_.choice().reason);
  }

 private:
  static Necklace checked(Necklace necklace) {
    check_memory(static_cast<double>(necklace.size()), kBeadBytes, "beads", "take fewer chains");
    return necklace;
  }

  /// Before they are found. What is too far for the box the finder refuses.
  void check_contacts(Span<const Vec3> points, const Box& box) const {
    const Necklace& necklace = finder_.necklace();
    const double largest = 2 * necklace.largest_radius() + query_.gap;
    if (largest < 0 || largest > std::min(kMaxListRadius, box.max_cutoff()) ||
        fits_if_all_are_near(necklace.size(), 0.5 * kContactBytes))
      return;
    const std::vector<double> reaches = reaches_of(necklace, query_.gap);
    NeighborPairsParams near;
    near.kind = ListKind::half;
    near.radii = reaches;
    std::vector<Vec3> places;
    places.reserve(necklace.size());
    for (const std::int32_t bead : necklace.particle())
      places.push_back(points[static_cast<std::size_t>(bead)]);
    check_memory(expected_pairs(places, box, near), kContactBytes, "contacts",
                 "take a smaller gap, or smaller radii");
  }

  necklace::ContactFinderParams params() {
    necklace::ContactFinderParams params;
    params.executor = &threads_;
    return params;
  }

  PresentThreads threads_;
  ContactQuery query_;
  ContactFinder finder_;
  mutable std::atomic<bool> used_{false};
};

/// Bins by bins, both halves.
template <class T, class Entry>
py::array square_of(std::size_t bins, const Entry& entry) {
  check_memory(static_cast<double>(bins) * static_cast<double>(bins), sizeof(T), "entries",
               "take fewer bins");
  std::vector<T> values;
  values.reserve(bins * bins);
  for (std::size_t a = 0; a < bins; ++a)
    for (std::size_t b = 0; b < bins; ++b) values.push_back(entry(a, b));
  const auto side = static_cast<py::ssize_t>(bins);
  return array_of(std::move(values), {side, side});
}

class Map {
 public:
  Map(const Chains& chains, ContactQuery query, std::int32_t max_bins)
      : necklace_(chains, 0), map_(checked(necklace_, max_bins), query, max_bins) {}

  void add(const Ints& i, const Ints& j) {
    const InUse in_use(used_, "ContactMap");
    check_memory(static_cast<double>(i.size()), sizeof(Contact), "contacts", "take a smaller gap");
    std::vector<Contact> contacts(static_cast<std::size_t>(i.size()));
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      contacts[k].i = i.data()[k];
      contacts[k].j = j.data()[k];
    }
    map_.add(contacts);
  }

  std::int64_t frames() const { return map_.frames(); }
  py::array first() const {
    std::vector<std::int32_t> first;
    for (std::size_t bin = 0; bin <= map_.bins(); ++bin) first.push_back(map_.first_place(bin));
    return array_of(std::move(first));
  }
  py::array contacts() const {
    return square_of<std::int64_t>(map_.bins(), [&](auto a, auto b) { return map_.contacts(a, b); });
  }
  py::array pairs() const {
    return square_of<std::int64_t>(map_.bins(), [&](auto a, auto b) { return map_.pairs(a, b); });
  }
  py::array frequency() const {
    return square_of<double>(map_.bins(), [&](auto a, auto b) { return map_.frequency(a, b); });
  }

 private:
  static const Necklace& checked(const Necklace& necklace, std::int32_t max_bins) {
    const double bins = std::min(static_cast<double>(max_bins), static_cast<double>(necklace.size()));
    check_memory(0.5 * bins * (bins + 1), sizeof(std::int64_t), "entries", "take fewer bins");
    return necklace;
  }

  Necklace necklace_;
  ContactMap map_;
  std::atomic<bool> used_{false};
};

}  // namespace

void bind_chains(py::module_& m) {
  py::class_<Chains>(m, "Chains")
      .def(py::init(&chains_of_rows), py::arg("particles"), py::arg("beads").noconvert(), py::arg("first"),
           py::arg("closed"))
      .def_static(
          "from_bonds",
          [](std::size_t particles, const Ints& bonds) {
            return Chains::from_bonds(particles, index_pairs_of(bonds));
          },
          py::arg("particles"), py::arg("bonds").noconvert())
      .def_static(
          "from_molecules",
          [](const Ints& molecules) {
            return Chains::from_molecules({molecules.data(), static_cast<std::size_t>(molecules.size())});
          },
          py::arg("molecules").noconvert())
      .def("count", &Chains::size)
      .def("particles", &Chains::particles)
      .def("closed", &Chains::closed, py::arg("chain"))
      .def("beads", &beads_of, py::arg("chain"))
      .def("bonds",
           [](const Chains& chains) {
             return rows_of<std::int32_t, 2>(chains.bonds(), [](const IndexPair& bond) { return bond; });
           })
      .def("unwrap", &unwrapped, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"));
  py::class_<ContactQuery>(m, "ContactQuery")
      .def(py::init([](double gap, int skip_bonds, bool within, bool between) {
             return ContactQuery{gap, skip_bonds, within, between};
           }),
           py::arg("gap"), py::arg("skip_bonds"), py::arg("within"), py::arg("between"));
  py::class_<Contacts>(m, "Contacts")
      .def(py::init<const Chains&, const Doubles&, ContactQuery, int>(), py::arg("chains"),
           py::arg("radii").noconvert(), py::arg("query"), py::arg("threads"))
      .def("find", &Contacts::find, py::arg("positions").noconvert(), py::arg("cell").noconvert(),
           py::arg("pbc"))
      .def("choice", &Contacts::choice);
  py::class_<Map>(m, "Map")
      .def(py::init<const Chains&, ContactQuery, std::int32_t>(), py::arg("chains"), py::arg("query"),
           py::arg("max_bins"))
      .def("add", &Map::add, py::arg("i").noconvert(), py::arg("j").noconvert())
      .def("frames", &Map::frames)
      .def("first", &Map::first)
      .def("contacts", &Map::contacts)
      .def("pairs", &Map::pairs)
      .def("frequency", &Map::frequency);
}

}  // namespace dch::python

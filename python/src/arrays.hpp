// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/engines/neighbor_pairs.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/exclusions.hpp>

namespace dch::python {

namespace py = pybind11;

/// Contiguous arrays; the Python sources convert what callers hand in. None is converted here.
using Doubles = py::array_t<double, py::array::c_style>;
using Ints = py::array_t<std::int32_t, py::array::c_style>;

/// A view of an array of n x 3. @throws InvalidParameter for another shape.
Span<const Vec3> points_of(const Doubles& array);
/// A view of an array of m x 2. @throws InvalidParameter for another shape.
Span<const IndexPair> index_pairs_of(const Ints& array);
Span<const double> numbers_of(const std::optional<Doubles>& array);
Span<const std::int32_t> numbers_of(const std::optional<Ints>& array);

/// The box of a cell (rows are its vectors) that is periodic along some of them. Vectors along open axes have
/// no meaning, so they may be zero, or depend on others.
/// @throws InvalidBox as Box::triclinic
Box box_of(const Doubles& cell, std::array<bool, 3> periodic);

/// A symmetric matrix of cutoffs. @throws InvalidParameter as TypeCutoffs
TypeCutoffs cutoffs_of(const Doubles& matrix);

/// An array over the elements of a vector, which lives as long as the array does.
template <class T>
py::array array_of(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape = {static_cast<py::ssize_t>(values.size())};
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const T* const data = owned->data();
  const py::capsule owner(owned.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  owned.release();
  return py::array_t<T>(std::move(shape), data, owner);
}

/// Bytes that may be taken before the machine swaps, or the container is full; a large number where nobody
/// says.
double available_memory();

/// @throws py::error_already_set, a MemoryError, if things take more than that; needs the interpreter's lock.
void check_memory(double things, double bytes_each, const char* what, const char* remedy);

/// Which arrays of pairs are asked for.
struct PairOutput {
  std::string quantities;             ///< letters of ijdDS, each at most once
  bool is_single = false;             ///< d and D are float32, else float64
  std::optional<py::tuple> arrays{};  ///< given ones, one for each letter, in place of new ones

  /// That new arrays take.
  double bytes_per_pair() const;
};

/// Arrays of some of i, j, d, D and S, filled pair by pair.
class PairArrays {
 public:
  /// @throws py::error_already_set, a MemoryError, if the machine has not that much memory; InvalidParameter
  /// for
  ///   given arrays of another type or with fewer rows than pairs.
  PairArrays(const PairOutput& output, std::int64_t pairs);

  void put(std::int64_t at, std::int32_t i, std::int32_t j, const NeighborPairs::Shift& s, Vec3 d) const {
    if (i_ != nullptr) i_[at] = i;
    if (j_ != nullptr) j_[at] = j;
    if (distance_ != nullptr) distance_[at] = std::sqrt(norm2(d));
    if (displacement_ != nullptr) displacement_[at] = d;
    if (single_distance_ != nullptr) single_distance_[at] = static_cast<float>(std::sqrt(norm2(d)));
    if (single_displacement_ != nullptr)
      single_displacement_[at] = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    if (shift_ != nullptr) shift_[at] = {s[0], s[1], s[2]};
  }
  /// Moves pairs to an earlier place.
  void move(std::int64_t from, std::int64_t count, std::int64_t to);
  /// Leaves out those behind. Of given arrays the beginnings stay, as views.
  void shorten(std::int64_t pairs);
  /// One for each letter.
  py::tuple tuple() const { return arrays_; }

 private:
  template <class T, class Element>
  void column(std::size_t k, const PairOutput& output, std::int64_t pairs, Element*& elements);

  py::tuple arrays_;
  bool are_given_ = false;
  std::int64_t *i_ = nullptr, *j_ = nullptr;
  double* distance_ = nullptr;
  Vec3* displacement_ = nullptr;
  float* single_distance_ = nullptr;
  std::array<float, 3>* single_displacement_ = nullptr;
  std::array<std::int64_t, 3>* shift_ = nullptr;
};

/// The pairs of a NeighborPairs that are within their cutoff, or all that are listed, row after row.
/// @param has_self by particle, whether it is paired with itself, with S = 0; empty if none is
py::tuple fill_pairs(const NeighborPairs& pairs, Span<const Vec3> positions, const PairOutput& output,
                     NeighborPairs::Within within, const std::vector<char>& has_self, Executor* executor);

}  // namespace dch::python

// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

#include <dch/base/error.hpp>

namespace dch::python {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double));

double norm(Vec3 v) { return std::sqrt(norm2(v)); }

Vec3 axis_vector(int axis) {
  Vec3 v;
  v[axis] = 1;
  return v;
}

/// A vector along v as long as others are; v if it has no direction, for Box to say so.
Vec3 scaled(Vec3 v, double length) { return norm(v) > 0 ? (length / norm(v)) * v : v; }

/// In the place of vectors along open axes: normal to those along periodic ones, and right-handed.
void complete(std::array<Vec3, 3>& cell, const std::array<bool, 3>& periodic) {
  const auto is_periodic = [&](std::size_t k) { return periodic[k % 3]; };
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 &a = cell[k], &b = cell[(k + 1) % 3], &c = cell[(k + 2) % 3];
    if (!is_periodic(k) && is_periodic(k + 1) && is_periodic(k + 2)) {
      const Vec3 normal = cross(scaled(b, 1), scaled(c, 1));
      a = norm(normal) > 0 ? scaled(normal, std::max(norm(b), norm(c))) : b;  // Box says that b and c depend
    } else if (is_periodic(k) && !is_periodic(k + 1) && !is_periodic(k + 2)) {
      const Vec3 along = scaled(a, 1);
      const auto off = [&](std::size_t axis) {
        const Vec3 e = axis_vector(static_cast<int>(axis % 3));
        return e - dot(e, along) * along;
      };
      constexpr double kParallel = 0.1;
      b = scaled(norm(off(k + 1)) > kParallel ? off(k + 1) : off(k), norm(a));
      c = scaled(cross(along, scaled(b, 1)), norm(a));
    }
  }
}

/// The number in a file; infinity if there is none.
double number_in(const char* path) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : std::numeric_limits<double>::infinity();
}

double free_of_machine() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word)
    if (word == "MemAvailable:" && file >> word) return 1024 * std::stod(word);
  return std::numeric_limits<double>::infinity();
}

/// What is left of the addresses that the process may have.
double free_of_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  const double used = number_in("/proc/self/statm") * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(static_cast<double>(limit.rlim_cur) - used, 0.0);
}

}  // namespace

Span<const Vec3> points_of(const Doubles& array) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InvalidParameter(
        "positions are an array of another shape than (n, 3); give three coordinates each");
  // Three doubles one after the other, as the array has them.
  return {reinterpret_cast<const Vec3*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

Span<const IndexPair> index_pairs_of(const Ints& array) {
  if (array.ndim() != 2 || array.shape(1) != 2)
    throw InvalidParameter("pairs are an array of another shape than (m, 2); give two particles each");
  return {reinterpret_cast<const IndexPair*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

Span<const double> numbers_of(const std::optional<Doubles>& array) {
  if (!array) return {};
  return {array->data(), static_cast<std::size_t>(array->size())};
}

Span<const std::int32_t> numbers_of(const std::optional<Ints>& array) {
  if (!array) return {};
  return {array->data(), static_cast<std::size_t>(array->size())};
}

Box box_of(const Doubles& cell, std::array<bool, 3> periodic) {
  if (!periodic[0] && !periodic[1] && !periodic[2]) return Box::none();
  const Span<const Vec3> rows = points_of(cell);
  if (rows.size() != 3) throw InvalidParameter("a cell has three vectors, of three components each");
  std::array<Vec3, 3> vectors{rows[0], rows[1], rows[2]};
  complete(vectors, periodic);
  return Box::triclinic(vectors[0], vectors[1], vectors[2], periodic);
}

const Box& LastBox::of(const Doubles& cell, std::array<bool, 3> periodic) {
  const bool is_same = cell.size() == static_cast<py::ssize_t>(cell_.size()) && periodic == periodic_ &&
                       std::equal(cell_.begin(), cell_.end(), cell.data());
  if (is_same) return box_;
  box_ = box_of(cell, periodic);
  periodic_ = {false, false, false};
  if (cell.size() == static_cast<py::ssize_t>(cell_.size())) {
    std::copy_n(cell.data(), cell_.size(), cell_.begin());
    periodic_ = periodic;
  }
  return box_;
}

bool is_plain(py::handle value, py::ssize_t rows) {
  if (!py::isinstance<py::array>(value)) return false;
  const auto array = py::reinterpret_borrow<py::array>(value);
  constexpr int kWanted = int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_};
  return (array.flags() & kWanted) == kWanted && array.dtype().is(py::dtype::of<double>()) &&
         array.ndim() == 2 && array.shape(1) == 3 && (rows < 0 || array.shape(0) == rows);
}

bool are_finite(const Doubles& array) {
  return std::all_of(array.data(), array.data() + array.size(), [](double x) { return std::isfinite(x); });
}

TypeCutoffs cutoffs_of(const Doubles& matrix) {
  const auto types = static_cast<int>(matrix.ndim() == 2 ? matrix.shape(0) : 0);
  return TypeCutoffs(types, std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
}

double available_memory() {
  double free = std::min(free_of_machine(), free_of_process());
  for (const auto& [limit, used] : {std::pair("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
                                    std::pair("/sys/fs/cgroup/memory/memory.limit_in_bytes",
                                              "/sys/fs/cgroup/memory/memory.usage_in_bytes")}) {
    const double left = number_in(limit) - number_in(used);
    if (left >= 0) free = std::min(free, left);  // not for NaN
  }
  return std::min(free, 1e18);
}

void check_memory(double things, double bytes_each, const char* what, const char* remedy) {
  constexpr double kAnyMachineHas = 1e8;
  const double bytes = bytes_each * things;
  if (bytes <= kAnyMachineHas) return;
  const double free = available_memory();
  if (bytes <= free) return;
  std::ostringstream text;
  text << "about " << things << ' ' << what << " take " << bytes << " bytes, and " << free << " are free; "
       << remedy;
  throw NotEnoughMemory(text.str());
}

double RecentMemory::available() {
  constexpr std::chrono::milliseconds kRecent(100);
  if (const auto now = std::chrono::steady_clock::now(); now >= until_) {
    bytes_ = available_memory();
    until_ = now + kRecent;
  }
  return bytes_;
}

bool fits_if_all_are_near(std::size_t particles, double bytes_per_pair, RecentMemory& memory) {
  constexpr std::size_t kFewParticles = 1000;
  const auto n = static_cast<double>(particles);
  return particles <= kFewParticles || bytes_per_pair * n * n <= 0.5 * memory.available();
}

bool fits_if_all_are_near(std::size_t particles, double bytes_per_pair) {
  RecentMemory now;
  return fits_if_all_are_near(particles, bytes_per_pair, now);
}

double PairOutput::bytes_per_pair() const {
  if (arrays) return 0;
  double bytes = 0;
  for (const char letter : quantities) {
    const bool is_real = letter == 'd' || letter == 'D';
    bytes += (letter == 'D' || letter == 'S' ? 3.0 : 1.0) *
             (is_real && is_single ? sizeof(float) : sizeof(double));
  }
  return bytes;
}

PairArrays::PairArrays(const PairOutput& output, std::int64_t pairs)
    : arrays_(output.quantities.size()), are_given_(output.arrays.has_value()) {
  if (are_given_ && output.arrays->size() != arrays_.size())
    throw InvalidParameter("out has " + std::to_string(output.arrays->size()) + " arrays for " +
                           std::to_string(arrays_.size()) + " quantities; give one for each");
  check_memory(static_cast<double>(pairs), output.bytes_per_pair(), "pairs",
               "take a smaller cutoff, or fewer quantities");
  for (std::size_t k = 0; k < output.quantities.size(); ++k) {
    switch (output.quantities[k]) {
      case 'i':
        column<std::int64_t>(k, output, pairs, columns_.i);
        break;
      case 'j':
        column<std::int64_t>(k, output, pairs, columns_.j);
        break;
      case 'd':
        if (output.is_single)
          column<float>(k, output, pairs, columns_.single_distance);
        else
          column<double>(k, output, pairs, columns_.distance);
        break;
      case 'D':
        if (output.is_single)
          column<float>(k, output, pairs, columns_.single_displacement);
        else
          column<double>(k, output, pairs, columns_.displacement);
        break;
      case 'S':
        column<std::int64_t>(k, output, pairs, columns_.shift);
        break;
      default:
        throw InvalidParameter(std::string("'") + output.quantities[k] + "' is none of i, j, d, D and S");
    }
  }
  if (are_given_) shorten(pairs);
}

/// An array of numbers of type T, new or given, and where the elements of its rows are.
template <class T, class Element>
void PairArrays::column(std::size_t k, const PairOutput& output, std::int64_t pairs, Element*& elements) {
  constexpr auto kWidth = static_cast<py::ssize_t>(sizeof(Element) / sizeof(T));
  py::array_t<T> array;
  if (are_given_) {
    const py::object given = (*output.arrays)[k];
    const auto name = [&] { return "out[" + std::to_string(k) + "], that of " + output.quantities[k] + ","; };
    if (!py::array_t<T, py::array::c_style>::check_(given))
      throw InvalidParameter(name() + " is no contiguous array of the type of its results; give one");
    array = py::reinterpret_borrow<py::array_t<T>>(given);
    if (array.ndim() != (kWidth == 1 ? 1 : 2) || (kWidth != 1 && array.shape(1) != kWidth) ||
        !array.writeable())
      throw InvalidParameter(name() + " has another shape than its results or cannot be written to");
    if (array.shape(0) < pairs)
      throw InvalidParameter(name() + " has " + std::to_string(array.shape(0)) + " rows for " +
                             std::to_string(pairs) + " pairs; give at least as many");
  } else if (kWidth == 1) {
    array = py::array_t<T>(pairs);
  } else {
    array = py::array_t<T>(std::vector<py::ssize_t>{static_cast<py::ssize_t>(pairs), kWidth});
  }
  elements = reinterpret_cast<Element*>(array.mutable_data());
  arrays_[k] = std::move(array);
}

void PairArrays::shorten(std::int64_t pairs) {
  for (std::size_t k = 0; k < arrays_.size(); ++k) {
    auto array = arrays_[k].cast<py::array>();
    if (are_given_) {
      arrays_[k] = array[py::slice(0, static_cast<py::ssize_t>(pairs), 1)];
      continue;
    }
    std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    shape[0] = pairs;
    array.resize(shape, false);  // nobody else has it
  }
}

}  // namespace dch::python

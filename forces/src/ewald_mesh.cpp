// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/ewald_mesh.hpp>

#include "base/aligned_vector.hpp"
#include "base/describe.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

using detail::AlignedVector;
using detail::ComplexArray;
using detail::MeshPoint;
using detail::MeshShape;

constexpr int kMaxSize = 10000;
const double kPi = std::acos(-1.0);

MeshShape shape_of(const std::array<int, 3>& sizes) {
  constexpr std::size_t kLine = 16;
  const std::size_t wanted = static_cast<std::size_t>(sizes[2]) + detail::kSplineRow;
  return {sizes[0], sizes[1], sizes[2], (wanted + kLine - 1) / kLine * kLine};
}

/// Squared absolute values of the Fourier transform of the spline on so many points.
std::vector<double> spline_moduli(int size, const detail::MeshKernels& kernels) {
  float weight[detail::kSplineRow], slope[detail::kSplineRow];
  kernels.spline(0, weight, slope);
  std::vector<double> moduli;
  for (int m = 0; m < size; ++m) {
    double re = 0, im = 0;
    for (int k = 0; k < detail::kSplineOrder; ++k) {
      re += double{weight[k]} * std::cos(2 * kPi * m * k / size);
      im += double{weight[k]} * std::sin(2 * kPi * m * k / size);
    }
    moduli.push_back(re * re + im * im);
  }
  // Splines of odd order have none of the shortest wave, which no mesh can tell from its neighbors.
  const auto n = moduli.size();
  for (std::size_t m = 0; m < n; ++m)
    if (moduli[m] < 1e-7) moduli[m] = 0.5 * (moduli[(m + n - 1) % n] + moduli[(m + 1) % n]);
  return moduli;
}

/// The vectors whose products with a position are its coordinates in units of the cell's vectors.
std::array<Vec3, 3> reciprocal_vectors(const Box& box) {
  std::array<Vec3, 3> vectors;
  for (int k = 0; k < 3; ++k) {
    const Vec3 normal = cross(box.vector((k + 1) % 3), box.vector((k + 2) % 3));
    vectors[static_cast<std::size_t>(k)] = (1 / dot(box.vector(k), normal)) * normal;
  }
  return vectors;
}

/// Of a wave number on a mesh of so many points.
double centered(int m, int size) { return m < (size + 1) / 2 ? m : m - size; }

struct Scratch {
  AlignedVector<float> numbers[4];
  ComplexArray first() { return {numbers[0].data(), numbers[1].data()}; }
  ComplexArray second() { return {numbers[2].data(), numbers[3].data()}; }
};

}  // namespace

struct EwaldMesh::Impl {
  MeshShape shape;
  double splitting, constant;
  LatticeSum of;
  detail::FftPlan along_x, along_y, along_z;
  const detail::MeshKernels& kernels = detail::force_kernels(instruction_set()).mesh;
  std::array<std::vector<double>, 3> moduli;
  Executor* executor = nullptr;
  Box box;  ///< that the influence function is of
  std::array<Vec3, 3> reciprocal;
  double scale = 0;                ///< of the influence function
  double of_mean = 0;              ///< the weight of the wave without length, which exerts no force
  AlignedVector<float> influence;  ///< [x][z][y], x up to half of its size
  AlignedVector<float> mesh, spectrum_re, spectrum_im;
  AlignedVector<MeshPoint> points;
  std::vector<std::array<float, 3>> slopes;
  std::vector<Scratch> scratch;
  std::vector<double> energies;  ///< by plane

  Impl(const std::array<int, 3>& sizes, double splitting_now, double constant_now, LatticeSum of_what)
      : shape(shape_of(sizes)),
        splitting(splitting_now),
        constant(constant_now),
        of(of_what),
        along_x(sizes[0]),
        along_y(sizes[1]),
        along_z(sizes[2]) {
    for (std::size_t axis = 0; axis < 3; ++axis) moduli[axis] = spline_moduli(sizes[axis], kernels);
    const std::size_t half = planes() * shape.plane();
    mesh.resize(shape.row(shape.x, 0));
    influence.resize(half);
    spectrum_re.resize(half);
    spectrum_im.resize(half);
    energies.resize(planes());
  }

  std::size_t planes() const { return static_cast<std::size_t>(shape.x) / 2 + 1; }
  int workers() const { return executor ? executor->threads() : 1; }
  void prepare(const Box& now);
  double weight(double x, double y, double z) const;
  double energy_of_mean(Span<const double> charges) const;
  void find_influence(int x);
  void place(Span<const Vec3> positions, Span<const double> charges);
  void spread();
  double convolve();
  void hand_out(Span<const double> charges, Span<Vec3> forces);
  /// Calls f(worker, begin, end) for shares of 0 .. count - 1.
  template <class F>
  void in_shares(std::size_t count, const F& f) {
    const int parts = workers();
    detail::run_parts(executor, parts, [&](int worker) {
      f(worker, share_begin(count, worker, parts), share_begin(count, worker + 1, parts));
    });
  }
};

void EwaldMesh::Impl::prepare(const Box& now) {
  const auto wanted =
      static_cast<std::size_t>(shape.z) * static_cast<std::size_t>(std::max(shape.x, shape.y));
  scratch.resize(static_cast<std::size_t>(workers()));
  for (Scratch& of_worker : scratch)
    for (auto& numbers : of_worker.numbers) numbers.resize(wanted);
  if (now == box) return;
  reciprocal = reciprocal_vectors(now);
  const double cubed = kPi * std::sqrt(kPi) * splitting * splitting * splitting;
  const bool is_dispersion = of == LatticeSum::dispersion;
  scale = is_dispersion ? -constant * cubed / (3 * now.volume()) : constant / (kPi * now.volume());
  of_mean = is_dispersion ? scale : 0;
  box = Box();  // what is thrown meanwhile leaves part of an influence function
  in_shares(planes(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x) find_influence(static_cast<int>(x));
  });
  box = now;
}

/// Of a wave m, with b = pi |m| / splitting: constant e^(-b^2) / (pi volume m^2), or of dispersion -constant
/// (sqrt(pi) splitting)^3 / (3 volume) ((1 - 2 b^2) e^(-b^2) + 2 sqrt(pi) b^3 erfc(b)). 0 for m = 0.
double EwaldMesh::Impl::weight(double x, double y, double z) const {
  const double m2 = norm2(x * reciprocal[0] + y * reciprocal[1] + z * reciprocal[2]);
  if (m2 == 0) return 0;
  const double b2 = kPi * kPi * m2 / (splitting * splitting);
  if (of == LatticeSum::coulomb) return scale * std::exp(-b2) / m2;
  const double b = std::sqrt(b2);
  return scale * ((1 - 2 * b2) * std::exp(-b2) + 2 * std::sqrt(kPi) * b2 * b * std::erfc(b));
}

/// Of the wave without length, in double: coefficients of dispersion have one sign, so on the mesh it would
/// drown the others.
double EwaldMesh::Impl::energy_of_mean(Span<const double> charges) const {
  if (of_mean == 0) return 0;
  const double sum = std::accumulate(charges.begin(), charges.end(), 0.0);
  return 0.5 * of_mean * sum * sum;
}

/// Weights over the moduli of splines. The shortest wave along an axis of even size has two signs, which a
/// mesh cannot tell apart: the mean of both, so that waves and their mirror images weigh the same.
void EwaldMesh::Impl::find_influence(int x) {
  float* at = influence.data() + static_cast<std::size_t>(x) * shape.plane();
  const double wx = centered(x, shape.x);
  for (int z = 0; z < shape.z; ++z)
    for (int y = 0; y < shape.y; ++y) {
      const double wy = centered(y, shape.y), wz = centered(z, shape.z);
      const bool both[3] = {2 * x == shape.x, 2 * y == shape.y, 2 * z == shape.z};
      double mean = weight(wx, wy, wz);
      if (both[0] || both[1] || both[2]) {
        mean = 0;
        for (int signs = 0; signs < 8; ++signs)
          mean += weight(both[0] && (signs & 1) ? -wx : wx, both[1] && (signs & 2) ? -wy : wy,
                         both[2] && (signs & 4) ? -wz : wz) /
                  8;
      }
      *at++ = static_cast<float>(
          mean / (moduli[0][static_cast<std::size_t>(x)] * moduli[1][static_cast<std::size_t>(y)] *
                  moduli[2][static_cast<std::size_t>(z)]));
    }
}

void EwaldMesh::Impl::place(Span<const Vec3> positions, Span<const double> charges) {
  points.resize(positions.size());
  slopes.resize(positions.size());
  const int sizes[3] = {shape.x, shape.y, shape.z};
  in_shares(positions.size(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      MeshPoint& point = points[i];
      point.charge = static_cast<float>(charges[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double turns = dot(positions[i], reciprocal[axis]);
        if (!std::isfinite(turns))
          throw InvalidPosition("the position of charge " + std::to_string(i) + " is not finite");
        // A tiny negative number is rounded up to a whole turn.
        const double at = (turns - std::floor(turns)) * sizes[axis];
        const double first = std::floor(at);
        point.first[axis] = static_cast<std::int32_t>(first) % sizes[axis];
        kernels.spline(static_cast<float>(at - first), point.weight[axis], point.slope[axis]);
      }
    }
  });
}

/// Each worker has planes of its own, and takes charges in their order: the same sums on any number of them.
void EwaldMesh::Impl::spread() {
  in_shares(static_cast<std::size_t>(shape.x), [&](int, std::size_t begin, std::size_t end) {
    const auto first = static_cast<int>(begin), last = static_cast<int>(end);
    std::fill(mesh.begin() + static_cast<std::ptrdiff_t>(shape.row(first, 0)),
              mesh.begin() + static_cast<std::ptrdiff_t>(shape.row(last, 0)), 0.0f);
    kernels.spread({shape, points.data(), points.size(), mesh.data(), first, last});
  });
}

double EwaldMesh::Impl::convolve() {
  const ComplexArray spectrum{spectrum_re.data(), spectrum_im.data()};
  const auto rows = static_cast<std::size_t>((shape.y + 1) / 2);
  const auto for_rows = [&](void (*transform)(const detail::RowsTask&)) {
    in_shares(rows, [&](int worker, std::size_t begin, std::size_t end) {
      Scratch& own = scratch[static_cast<std::size_t>(worker)];
      for (std::size_t y = begin; y < end; ++y)
        transform({shape, &along_x, static_cast<int>(y), mesh.data(), spectrum, own.first(), own.second()});
    });
  };
  for_rows(kernels.forward);
  in_shares(planes(), [&](int worker, std::size_t begin, std::size_t end) {
    Scratch& own = scratch[static_cast<std::size_t>(worker)];
    for (std::size_t x = begin; x < end; ++x) {
      const std::size_t at = x * shape.plane();
      energies[x] = kernels.convolve({shape,
                                      &along_y,
                                      &along_z,
                                      influence.data() + at,
                                      {spectrum.re + at, spectrum.im + at},
                                      own.first(),
                                      own.second()});
    }
  });
  for_rows(kernels.backward);
  double energy = 0;
  // Planes but the first, and the middle one, stand for their mirror images too.
  for (std::size_t x = 0; x < planes(); ++x)
    energy += (x == 0 || 2 * x == static_cast<std::size_t>(shape.x) ? 0.5 : 1.0) * energies[x];
  return energy;
}

void EwaldMesh::Impl::hand_out(Span<const double> charges, Span<Vec3> forces) {
  static_assert(sizeof(std::array<float, 3>) == sizeof(float[3]));
  in_shares(points.size(), [&](int, std::size_t begin, std::size_t end) {
    if (begin == end) return;
    kernels.gather({shape, points.data() + begin, end - begin, mesh.data(),
                    reinterpret_cast<float(*)[3]>(slopes.data() + begin)});
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 slope = double{slopes[i][0]} * shape.x * reciprocal[0] +
                         double{slopes[i][1]} * shape.y * reciprocal[1] +
                         double{slopes[i][2]} * shape.z * reciprocal[2];
      forces[i] = forces[i] - charges[i] * slope;
    }
  });
}

EwaldMesh::EwaldMesh(std::array<int, 3> sizes, double splitting, double constant, LatticeSum of) {
  for (int& size : sizes) {
    if (size < detail::kSplineOrder || size > kMaxSize)
      throw InvalidParameter("a mesh of " + std::to_string(size) +
                             " points along a vector was asked for; 5 to " + std::to_string(kMaxSize) +
                             " are to be had");
    size = detail::next_fft_length(size);
  }
  if (!(std::isfinite(splitting) && splitting > 0))
    throw InvalidParameter("the splitting parameter of a mesh is " + detail::describe(splitting) +
                           "; it must be finite and positive");
  if (!(std::isfinite(constant) && constant >= 0))
    throw InvalidParameter("the constant of a mesh is " + detail::describe(constant) +
                           "; it must be finite and not negative");
  impl_ = std::make_unique<Impl>(sizes, splitting, constant, of);
}

EwaldMesh::~EwaldMesh() = default;
EwaldMesh::EwaldMesh(EwaldMesh&&) noexcept = default;
EwaldMesh& EwaldMesh::operator=(EwaldMesh&&) noexcept = default;

void EwaldMesh::set_executor(Executor* executor) { impl_->executor = executor; }

std::array<int, 3> EwaldMesh::sizes() const { return {impl_->shape.x, impl_->shape.y, impl_->shape.z}; }

double EwaldMesh::add_forces(Span<const Vec3> positions, Span<const double> charges, const Box& box,
                             Span<Vec3> forces) {
  if (charges.size() != positions.size() || forces.size() != positions.size())
    throw InvalidParameter(std::to_string(charges.size()) + " charges and room for " +
                           std::to_string(forces.size()) + " forces given for " +
                           std::to_string(positions.size()) + " positions; give one each");
  if (!(box.periodic(0) && box.periodic(1) && box.periodic(2)))
    throw InvalidBox("a mesh was used in the box " + box.description() +
                     "; it has to be periodic along all three vectors");
  impl_->prepare(box);
  impl_->place(positions, charges);
  impl_->spread();
  const double energy = impl_->convolve() + impl_->energy_of_mean(charges);
  impl_->hand_out(charges, forces);
  return energy;
}

}  // namespace dch

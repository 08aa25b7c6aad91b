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
#include "mesh_influence.hpp"
#include "simd/force_kernels.hpp"
#include "turns.hpp"

namespace dch {
namespace {

using detail::AlignedVector;
using detail::ComplexArray;
using detail::MeshPoint;
using detail::MeshShape;

constexpr int kMaxSize = 10000;

MeshShape shape_of(const std::array<int, 3>& sizes) {
  constexpr std::size_t kLine = 16;
  const std::size_t wanted = static_cast<std::size_t>(sizes[2]) + detail::kSplineRow;
  return {sizes[0], sizes[1], sizes[2], (wanted + kLine - 1) / kLine * kLine};
}

struct Scratch {
  AlignedVector<float> numbers[4];
  ComplexArray first() { return {numbers[0].data(), numbers[1].data()}; }
  ComplexArray second() { return {numbers[2].data(), numbers[3].data()}; }
};

}  // namespace

struct EwaldMesh::Impl {
  MeshShape shape;
  detail::FftPlan along_x, along_y, along_z;
  const detail::MeshKernels& kernels = detail::force_kernels(instruction_set()).mesh;
  detail::MeshInfluence weights;
  Executor* executor = nullptr;
  Box box;  ///< that the influence function is of
  std::array<Vec3, 3> reciprocal;
  AlignedVector<float> influence;  ///< [x][z][y], x up to half of its size
  AlignedVector<float> mesh, spectrum_re, spectrum_im;
  AlignedVector<MeshPoint> points;
  std::vector<std::array<float, 3>> slopes;
  std::vector<Scratch> scratch;
  std::vector<double> energies;  ///< by plane

  Impl(const std::array<int, 3>& sizes, detail::LatticeWeights of_waves)
      : shape(shape_of(sizes)),
        along_x(sizes[0]),
        along_y(sizes[1]),
        along_z(sizes[2]),
        weights(sizes, of_waves, kernels) {
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
  double energy_of_mean(Span<const double> charges) const;
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
  weights.set_box(now);
  reciprocal = detail::reciprocal_vectors(now);
  box = Box();  // what is thrown meanwhile leaves part of an influence function
  in_shares(planes(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      weights.fill_plane(static_cast<int>(x), influence.data() + x * shape.plane());
  });
  box = now;
}

/// Of the wave without length, in double: coefficients of dispersion have one sign, so on the mesh it would
/// drown the others.
double EwaldMesh::Impl::energy_of_mean(Span<const double> charges) const {
  if (weights.of_mean() == 0) return 0;
  const double sum = std::accumulate(charges.begin(), charges.end(), 0.0);
  return 0.5 * weights.of_mean() * sum * sum;
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
        if (point.charge == 0) continue;
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
  impl_ = std::make_unique<Impl>(sizes, detail::LatticeWeights{of, splitting, constant});
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

// SPDX-License-Identifier: MIT
//
// The loops of sphere_kernels.hpp, a pair in each lane of a vector: included once for each instruction set.
// No function of a library is called that is inline, since one compiled for a wider set could then be linked
// into all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "simd/native_doubles.hpp"
#include "simd/sphere_kernels.hpp"

namespace dch::kinetic {
namespace {

using detail::Doubles;
using detail::kWidth;
using detail::load;
using detail::store;
using Masks __attribute__((vector_size(kWidth * sizeof(double)))) = std::int64_t;
inline constexpr std::size_t kLanes = kWidth;
inline constexpr double kNone = std::numeric_limits<double>::infinity();

/// A bit for each lane.
inline unsigned bits_of(const Masks& masks) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(masks));
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(masks)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(masks)));
#else
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) bits |= masks[lane] != 0 ? 1U << lane : 0;
  return bits;
#endif
}

inline void square_root(const Doubles& of, Doubles& root) {
#if defined(__AVX512F__)
  root = _mm512_sqrt_pd(of);
#elif defined(__AVX__)
  root = _mm256_sqrt_pd(of);
#elif defined(__SSE2__)
  root = _mm_sqrt_pd(of);
#else
  for (std::size_t lane = 0; lane < kLanes; ++lane) root[lane] = __builtin_sqrt(of[lane]);
#endif
}

/// One step of the transposition of rows: two of them exchange every other group of `kStep` numbers.
template <std::size_t kStep, std::size_t... kLane>
[[gnu::always_inline]] inline void exchange(Doubles& a, Doubles& b, std::index_sequence<kLane...>) {
  const Doubles low = __builtin_shufflevector(a, b, (kLane & kStep ? kLanes + kLane - kStep : kLane)...);
  b = __builtin_shufflevector(a, b, (kLane & kStep ? kLanes + kLane : kLane + kStep)...);
  a = low;
}
template <std::size_t kStep, std::size_t kRows>
[[gnu::always_inline]] inline void transpose(Doubles* rows) {
  if constexpr (kStep < kRows) {
    for (std::size_t k = 0; k < kRows; ++k)
      if ((k & kStep) == 0) exchange<kStep>(rows[k], rows[k + kStep], std::make_index_sequence<kLanes>());
    transpose<2 * kStep, kRows>(rows);
  }
}

/// Numbers of a row, of which lanes beyond the last one repeat the first.
struct LaneIds {
  LaneIds(const std::int32_t* row, std::size_t count) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) id[lane] = row[lane < count ? lane : 0];
  }
  std::int32_t id[kLanes];
};

struct Vectors {
  Doubles x, y, z;
};
[[gnu::always_inline]] inline Doubles dot_of(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Flights {
  Flights(const Flight* flights, const LaneIds& lanes) {
    for (std::size_t first = 0; first < 8; first += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        load(reinterpret_cast<const double*>(flights + lanes.id[lane]) + first, field[first + lane]);
      transpose<1, kLanes>(field + first);
    }
  }
  Doubles field[8];  ///< as in a Flight
};

/// What Box::nearest_image does along an axis of an orthorhombic box, and by how much. Returns whether all
/// are so near that this is true.
[[gnu::always_inline]] inline bool to_nearest(double period, Doubles& d, Doubles& shift) {
  const Doubles zero{};
  const double half = 0.5 * period, most = 1.5 * period;
  const bool is_near = bits_of((d > most) | (d < -most)) == 0;
  shift = d > half ? zero - period : d < -half ? zero + period : zero;
  d += shift;
  return is_near;
}
[[gnu::always_inline]] inline bool to_nearest(const NearestImages& box, Vectors& d, Vectors& shift) {
  const bool is_near_x = to_nearest(box.periods.x, d.x, shift.x);
  const bool is_near_y = to_nearest(box.periods.y, d.y, shift.y);
  return to_nearest(box.periods.z, d.z, shift.z) && is_near_x && is_near_y;
}

/// Adds what brings the pairs of the marked lanes to their nearest images.
[[gnu::noinline]] inline void shift_lanes(unsigned far, const NearestImages& box, const Vectors& present,
                                          Vectors& apart) {
  double at[3][kLanes], to[3][kLanes];
  store(present.x, at[0]);
  store(present.y, at[1]);
  store(present.z, at[2]);
  store(apart.x, to[0]);
  store(apart.y, to[1]);
  store(apart.z, to[2]);
  for (; far != 0; far &= far - 1) {
    const int lane = __builtin_ctz(far);
    const double displacement[3] = {at[0][lane], at[1][lane], at[2][lane]};
    double shift[3];
    shift_to_nearest(*box.images, displacement, shift);
    for (int axis = 0; axis < 3; ++axis) to[axis][lane] += shift[axis];
  }
  load(to[0], apart.x);
  load(to[1], apart.y);
  load(to[2], apart.z);
}

/// Approach::meets() and Approach::time_to_contact() of sphere_motion.hpp, operation by operation.
inline void time_of_contact(const Vectors& r, const Vectors& v, const Doubles& d, const Doubles& g,
                            const Doubles& start, double now, Doubles& time) {
  const Doubles zero{};
  const Doubles half = dot_of(r, v) - d * g, square = dot_of(v, v) - g * g;
  const Vectors along{d * v.x - g * r.x, d * v.y - g * r.y, d * v.z - g * r.z};
  const Vectors across{r.y * v.z - r.z * v.y, r.z * v.x - r.x * v.z, r.x * v.y - r.y * v.x};
  const Doubles discriminant = dot_of(along, along) - dot_of(across, across);
  const Doubles excess = dot_of(r, r) - d * d;
  const Masks parts = (half >= zero) & ((g == zero) | (square >= zero));
  const Masks meets = (discriminant > zero) & ~parts;
  Doubles root;
  square_root(discriminant > zero ? discriminant : zero, root);
  const Masks nears = half < zero;
  const Doubles after = (nears ? excess : half + root) / (nears ? root - half : -square);
  const Doubles at = start + after;
  time = meets ? (zero + now < at ? at : zero + now) : zero + kNone;
}

inline double contact_times(const Flight* flights, std::int32_t id, const std::int32_t* row,
                            std::size_t count, const NearestImages& box, const ContactLaw& law,
                            double* times) {
  const Flight self = flights[id];
  const Doubles zero{};
  Doubles least = zero + kNone;
  for (std::size_t k = 0; k < count; k += kLanes) {
    const Flights other(flights, LaneIds(row + k, count - k));
    const auto& [x, y, z, time, vx, vy, vz, radius] = other.field;
    const Doubles start = time > self.time ? time : zero + self.time;
    const Doubles mine = start - self.time, theirs = start - time, since = law.now - start;
    const Vectors v{vx - self.velocity.x, vy - self.velocity.y, vz - self.velocity.z};
    Vectors apart{(x + theirs * vx) - (self.position.x + mine * self.velocity.x),
                  (y + theirs * vy) - (self.position.y + mine * self.velocity.y),
                  (z + theirs * vz) - (self.position.z + mine * self.velocity.z)};
    const Vectors present{apart.x + since * v.x, apart.y + since * v.y, apart.z + since * v.z};
    const unsigned far = bits_of(dot_of(present, present) > box.sure2);
    if (far != 0) {
      Vectors nearest = present, shift;
      if (to_nearest(box, nearest, shift)) {
        apart = {apart.x + shift.x, apart.y + shift.y, apart.z + shift.z};
      } else {
        shift_lanes(far, box, present, apart);
      }
    }
    const Doubles sum = self.radius + radius;
    Doubles at;
    time_of_contact(apart, v, sum * (law.scale + law.growth * start), sum * law.growth, start, law.now, at);
    store(at, times + k);
    least = at < least ? at : least;
  }
  double of_lanes[kLanes], result = kNone;
  store(least, of_lanes);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    result = of_lanes[lane] < result ? of_lanes[lane] : result;
  return result;
}

/// As in a Ball. Where vectors hold eight numbers each has two balls before they are transposed.
struct Balls {
  Balls(const Ball* balls, const LaneIds& lanes) {
    if constexpr (kLanes == 8) {
      for (std::size_t k = 0; k < 4; ++k) {
        const auto* const second = reinterpret_cast<const double*>(balls + lanes.id[(k + 4) % kLanes]);
        __builtin_memcpy(&field[k], balls + lanes.id[k], sizeof(Ball));
        __builtin_memcpy(reinterpret_cast<char*>(&field[k]) + sizeof(Ball), second, sizeof(Ball));
      }
      transpose<1, 4>(field);
    } else {
      for (std::size_t first = 0; first < 4; first += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          load(reinterpret_cast<const double*>(balls + lanes.id[lane]) + first, field[first + lane]);
        transpose<1, kLanes>(field + first);
      }
    }
  }
  Doubles field[4];
};

/// Which of the marked lanes have an image within reach.
[[gnu::noinline]] inline unsigned find_near_images(unsigned far, const NearestImages& box,
                                                   const Vectors& apart, const Doubles& reach2) {
  unsigned touch = 0;
  for (; far != 0; far &= far - 1) {
    const int lane = __builtin_ctz(far);
    const double displacement[3] = {apart.x[lane], apart.y[lane], apart.z[lane]};
    if (nearest2(*box.images, displacement) <= reach2[lane]) touch |= 1U << lane;
  }
  return touch;
}

inline std::size_t find_touching(const Ball* balls, std::int32_t id, const std::int32_t* row,
                                 std::size_t count, const NearestImages& box, std::int32_t* found) {
  const Ball self = balls[id];
  std::size_t size = 0;
  for (std::size_t k = 0; k < count; k += kLanes) {
    const Balls other(balls, LaneIds(row + k, count - k));
    const auto& [x, y, z, radius] = other.field;
    const Vectors apart{x - self.center.x, y - self.center.y, z - self.center.z};
    const Doubles distance2 = dot_of(apart, apart), reach = self.radius + radius, reach2 = reach * reach;
    unsigned touch = bits_of(distance2 <= reach2);
    const unsigned far = bits_of(distance2 > box.sure2) & ~touch;
    if (far != 0) {
      Vectors nearest = apart, shift;
      if (to_nearest(box, nearest, shift)) {
        touch |= bits_of(dot_of(nearest, nearest) <= reach2);
      } else {
        touch |= find_near_images(far, box, apart, reach2);
      }
    }
    const std::size_t lanes = count - k < kLanes ? count - k : kLanes;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      found[size] = row[k + lane];
      size += touch >> lane & 1;
    }
  }
  return size;
}

}  // namespace
}  // namespace dch::kinetic

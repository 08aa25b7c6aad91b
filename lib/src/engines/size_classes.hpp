// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/lists/list_params.hpp>

namespace dch::detail {

/// What requests say of the sizes of particles, kept to tell whether they say the same again.
class SizeRecord {
 public:
  bool says_the_same(Span<const ListParams> requests) const;
  void keep(Span<const ListParams> requests);
  void forget() { each_.clear(); }
  std::size_t memory_bytes() const;

 private:
  struct Request {
    double skin;
    TypeCutoffs cutoffs;
    std::vector<double> radii;
    std::vector<std::int32_t> types;
    bool has_sizes_of_first;  ///< `radii` and `types` were those of the first request, and are not kept again
  };
  static bool has_sizes_of(const ListParams& request, const ListParams& other);
  std::vector<Request> each_;
};

/// Particles sorted into classes of about the same size, and how far those of two classes look for each
/// other.
struct SizeClasses {
  SizeClasses() = default;
  /// Classes for lists of n particles; the first request decides.
  /// @param told_apart whether there may be more than one
  SizeClasses(Span<const ListParams> requests, std::size_t n, bool told_apart);

  double reach_of(std::size_t a, std::size_t b) const { return reach[a * count + b]; }

  std::size_t count = 0;         ///< the smallest first
  std::vector<std::int32_t> of;  ///< class of each particle
  std::vector<double> reach;     ///< largest list radius of a pair, count x count [length]

 private:
  template <class Size>
  void divide(const Size& size, double smallest, double largest);
};

}  // namespace dch::detail

// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>
#include <lammps_host.h>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>

namespace LAMMPS_NS {

class Modify;
class NeighList;
class Neighbor;
class Pair;

/// The history of contacts that LAMMPS's fix NEIGH_HISTORY keeps for a granular pair style: for each neighbor
/// in each row a mark and three numbers. The fix carries them over builds, exchanges and restarts. Its class
/// shows where they are to all, but is in a header that LAMMPS does not install. Where they are in it has to
/// be known; that they are there is seen from the pointer behind them, which leads to the style.
class NeighHistory {
 public:
  /// @return whether a fix was found that keeps the history of this style
  bool find(const Modify& modify, const Pair& style);

  /// Of the rows of the last build.
  std::int32_t* const* marks() const { return read<std::int32_t**>(0); }
  double* const* values() const { return read<double**>(1); }

 private:
  template <class T>
  T read(std::size_t pointer) const;

  const char* members_ = nullptr;  ///< those two pointers, and that to the style
};

/// Has a style get the lists that another one has asked for since there were `first` requests, as if it had
/// asked itself: pair_style hybrid looks for the style that it made. The class of requests is in a header
/// that LAMMPS does not install; who asks is said in one of the first two words of it.
/// @return whether there are such requests, and all of them have been turned over
bool turn_over_requests(Neighbor& neighbor, int first, const Pair& from, Pair& to);

/// The pairs of a list as two columns, cut where history does not go on in memory.
class ContactColumns {
 public:
  struct Piece {
    dch::Span<const std::int32_t> i, j;
    dch::Span<std::int32_t> marks;  ///< none without history
    dch::Span<dch::Vec3> values;
  };

  /// @param history null if there is none
  /// @param weights of pairs of bonded atoms, by kind; those with weight 0 are left out
  void take(const NeighList& list, const NeighHistory* history, const double* weights);

  const std::vector<Piece>& pieces() const { return pieces_; }
  std::size_t pairs() const { return i_.size(); }
  std::size_t memory_bytes() const { return (i_.capacity() + j_.capacity()) * sizeof(std::int32_t); }

 private:
  /// Where a piece begins.
  struct Cut {
    std::size_t pair;
    std::int32_t* mark;
    double* value;
  };

  std::vector<std::int32_t> i_, j_;
  std::vector<Piece> pieces_;
};

}  // namespace LAMMPS_NS

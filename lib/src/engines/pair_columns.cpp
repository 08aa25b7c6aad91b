// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <dch/base/error.hpp>
#include <dch/engines/pair_columns.hpp>

#include "engines/pair_finder.hpp"
#include "engines/pair_geometry.hpp"

namespace dch {
namespace {

using detail::PairChunk;

std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

bool wants_geometry(const PairColumns& c) {
  return c.shift != nullptr || c.distance != nullptr || c.displacement != nullptr ||
         c.single_distance != nullptr || c.single_displacement != nullptr;
}

/// How many parts rows are cut into: so few that places for each particle in each part are not more than
/// pairs.
int parts_for(Executor* executor, std::int64_t pairs, std::size_t particles) {
  const int threads = executor != nullptr ? executor->threads() : 1;
  const std::int64_t most = 1 + pairs / static_cast<std::int64_t>(1 + particles);
  return static_cast<int>(std::min<std::int64_t>(threads, most));
}

void run(Executor* executor, int parts, const std::function<void(int)>& task) {
  if (parts == 1) return task(0);
  executor->run(parts, task);
}

/// Fills columns with pairs that an engine found, each once, in the row of either of its particles.
class ColumnFiller {
 public:
  ColumnFiller(const detail::PairFinder& finder, Span<const char> with_itself)
      : executor_(finder.params().executor),
        is_half_(finder.params().kind == ListKind::half),
        with_itself_(with_itself),
        particles_(finder.given().size()),
        list_(finder.find(ListKind::half, RowOrder::unsorted)),
        geometry_(finder.given(), finder.home(), finder.box()),
        parts_(parts_for(executor_, list_.first.back(), particles_)),
        next_(static_cast<std::size_t>(parts_)) {
    run(executor_, parts_, [&](int part) { count(part); });
    find_places();
    if (pairs() > finder.params().max_pairs)
      detail::refuse_pairs(static_cast<double>(pairs()), "pairs", finder.params().max_pairs);
  }

  std::int64_t pairs() const { return first_.back(); }

  void fill(const PairColumns& columns) {
    put_themselves(columns);
    run(executor_, parts_, [&](int part) { fill_part(part, columns); });
    if (columns.i == nullptr) return;
    for_ranges(executor_, particles_, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i)
        std::fill(columns.i + first_[i], columns.i + first_[i + 1], static_cast<std::int64_t>(i));
    });
  }

 private:
  template <class F>
  void for_each_row(int part, const F& f) const {
    const std::size_t end = share_begin(list_.size(), part + 1, parts_);
    for (std::size_t k = share_begin(list_.size(), part, parts_); k < end; ++k)
      f(list_.particle.empty() ? static_cast<std::int32_t>(k) : list_.particle[k], list_.row(k));
  }

  void count(int part) {
    std::vector<std::int64_t>& counts = next_[static_cast<std::size_t>(part)];
    counts.assign(particles_, 0);
    for_each_row(part, [&](std::int32_t i, Span<const std::int32_t> row) {
      if (is_half_) {
        for (const std::int32_t j : row) ++counts[as_index(std::min(i, j))];
      } else {
        counts[as_index(i)] += static_cast<std::int64_t>(row.size());
        for (const std::int32_t j : row) ++counts[as_index(j)];
      }
    });
  }

  /// Turns counts into places.
  void find_places() {
    first_.resize(particles_ + 1);
    std::int64_t at = 0;
    for (std::size_t i = 0; i < particles_; ++i) {
      first_[i] = at;
      if (!with_itself_.empty()) at += static_cast<std::int64_t>(with_itself_[i] != 0);
      for (std::vector<std::int64_t>& next : next_) {
        const std::int64_t here = next[i];
        next[i] = at;
        at += here;
      }
    }
    first_[particles_] = at;
  }

  void put_themselves(const PairColumns& c) const {
    for (std::size_t i = 0; i < with_itself_.size(); ++i) {
      if (with_itself_[i] == 0) continue;
      const std::int64_t at = first_[i];
      if (c.j != nullptr) c.j[at] = static_cast<std::int64_t>(i);
      if (c.shift != nullptr) c.shift[at] = {};
      if (c.distance != nullptr) c.distance[at] = 0;
      if (c.displacement != nullptr) c.displacement[at] = {};
      if (c.single_distance != nullptr) c.single_distance[at] = 0;
      if (c.single_displacement != nullptr) c.single_displacement[at] = {};
    }
  }

  void fill_part(int part, const PairColumns& columns) {
    const bool is_measured = wants_geometry(columns);
    const bool has_distances = columns.distance != nullptr || columns.single_distance != nullptr;
    std::int64_t* const next = next_[static_cast<std::size_t>(part)].data();
    PairChunk chunk;
    for_each_row(part, [&](std::int32_t i, Span<const std::int32_t> row) {
      for (std::size_t done = 0; done < row.size(); done += PairChunk::kMost) {
        const std::int32_t* const j = row.data() + done;
        const int count = static_cast<int>(std::min<std::size_t>(row.size() - done, PairChunk::kMost));
        if (is_measured) geometry_.measure(i, j, count, chunk);
        if (columns.shift != nullptr) chunk.count_shifts(count);
        if (has_distances) chunk.take_distances(count);
        if (is_half_)
          put_half(i, j, count, chunk, next, columns);
        else
          put_full(i, j, count, chunk, next, columns);
      }
    });
  }

  static void put_half(std::int32_t i, const std::int32_t* j, int count, const PairChunk& chunk,
                       std::int64_t* next, const PairColumns& columns) {
    std::array<std::int64_t, PairChunk::kMost> place;
    std::array<std::int32_t, PairChunk::kMost> other;
    std::array<int, PairChunk::kMost> sign;
    for (int k = 0; k < count; ++k) {
      place[k] = next[std::min(i, j[k])]++;
      other[k] = std::max(i, j[k]);
      sign[k] = j[k] < i ? -1 : 1;
    }
    put(
        count, chunk, columns, [&](int k) { return place[k]; }, [&](int k) { return other[k]; },
        [&](int k) { return sign[k]; });
  }

  static void put_full(std::int32_t i, const std::int32_t* j, int count, const PairChunk& chunk,
                       std::int64_t* next, const PairColumns& columns) {
    const std::int64_t own = next[i];
    next[i] += count;
    put(
        count, chunk, columns, [&](int k) { return own + k; }, [&](int k) { return j[k]; },
        [](int) { return 1; });
    std::array<std::int64_t, PairChunk::kMost> place;
    for (int k = 0; k < count; ++k) place[k] = next[j[k]]++;
    put(
        count, chunk, columns, [&](int k) { return place[k]; }, [&](int) { return i; },
        [](int) { return -1; });
  }

  /// Column by column: the pairs with other(k) at their places, turned where the sign is -1.
  template <class Place, class Other, class Sign>
  static void put(int count, const PairChunk& chunk, const PairColumns& columns, const Place& place,
                  const Other& other, const Sign& sign) {
    const auto& [a, b, c] = chunk.whole_shift;
    const auto& [x, y, z] = chunk.displacement;
    if (columns.j != nullptr)
      for (int k = 0; k < count; ++k) columns.j[place(k)] = other(k);
    if (columns.shift != nullptr)
      for (int k = 0; k < count; ++k)
        columns.shift[place(k)] = {sign(k) * a[k], sign(k) * b[k], sign(k) * c[k]};
    if (columns.displacement != nullptr)
      for (int k = 0; k < count; ++k)
        columns.displacement[place(k)] = {sign(k) * x[k], sign(k) * y[k], sign(k) * z[k]};
    if (columns.single_displacement != nullptr)
      for (int k = 0; k < count; ++k)
        columns.single_displacement[place(k)] = {static_cast<float>(sign(k) * x[k]),
                                                 static_cast<float>(sign(k) * y[k]),
                                                 static_cast<float>(sign(k) * z[k])};
    if (columns.distance != nullptr)
      for (int k = 0; k < count; ++k) columns.distance[place(k)] = chunk.distance[k];
    if (columns.single_distance != nullptr)
      for (int k = 0; k < count; ++k)
        columns.single_distance[place(k)] = static_cast<float>(chunk.distance[k]);
  }

  Executor* executor_;
  bool is_half_;
  Span<const char> with_itself_;
  std::size_t particles_;
  NeighborList list_;
  detail::PairGeometry geometry_;
  int parts_;
  std::vector<std::vector<std::int64_t>> next_;  ///< by part and particle, where its next pair goes
  std::vector<std::int64_t> first_;
};

void put_pair(const PairColumns& c, std::int64_t at, std::int32_t i, std::int32_t j,
              const NeighborPairs::Shift& s, Vec3 d) {
  if (c.i != nullptr) c.i[at] = i;
  if (c.j != nullptr) c.j[at] = j;
  if (c.shift != nullptr) c.shift[at] = {s[0], s[1], s[2]};
  if (c.distance != nullptr) c.distance[at] = std::sqrt(norm2(d));
  if (c.displacement != nullptr) c.displacement[at] = d;
  if (c.single_distance != nullptr) c.single_distance[at] = static_cast<float>(std::sqrt(norm2(d)));
  if (c.single_displacement != nullptr)
    c.single_displacement[at] = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

/// To an earlier place.
void move_pairs(const PairColumns& columns, std::int64_t from, std::int64_t count, std::int64_t to) {
  const auto moved = [&](auto* column) {
    if (column != nullptr) std::copy(column + from, column + from + count, column + to);
  };
  moved(columns.i), moved(columns.j), moved(columns.shift), moved(columns.distance),
      moved(columns.displacement);
  moved(columns.single_distance), moved(columns.single_displacement);
}

}  // namespace

std::int64_t columns_of(const NeighborPairs& pairs, Span<const Vec3> positions, NeighborPairs::Within within,
                        Span<const char> with_itself, Executor* executor, const MakeColumns& make_columns) {
  const std::size_t n = positions.size();
  // Rows have places for all that is listed; a range of rows leaves no gap within.
  std::vector<std::int64_t> place(n + 1, 0), end(n + 1, -1);
  const auto is_with_itself = [&](std::size_t i) { return !with_itself.empty() && with_itself[i] != 0; };
  for (std::size_t i = 0; i < n; ++i)
    place[i + 1] =
        place[i] + pairs.listed_in_row(static_cast<std::int32_t>(i)) + static_cast<int>(is_with_itself(i));
  const PairColumns columns = make_columns(place.back());
  for_ranges(executor, static_cast<std::int32_t>(n), [&](std::int32_t from, std::int32_t to) {
    std::int64_t at = place[as_index(from)];
    for (std::int32_t i = from; i < to; ++i) {
      if (is_with_itself(as_index(i))) put_pair(columns, at++, i, i, {}, {});
      pairs.for_each_in_row(
          i, positions,
          [&](std::int32_t j, const NeighborPairs::Shift& s, Vec3 d) { put_pair(columns, at++, i, j, s, d); },
          within);
    }
    if (from < to) end[as_index(from)] = at;
  });
  std::int64_t found = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (end[i] < 0) continue;  // no range begins here
    const std::int64_t count = end[i] - place[i];
    if (found < place[i]) move_pairs(columns, place[i], count, found);
    found += count;
  }
  return found;
}

std::int64_t neighbor_columns(Span<const Vec3> positions, const Box& box, const NeighborPairsParams& params,
                              Span<const char> with_itself, const MakeColumns& columns) {
  if (params.skin != 0)
    throw InvalidParameter("the skin is " + std::to_string(params.skin) +
                           "; pairs in columns have none: give 0");
  detail::PairFinder finder(positions, box, params);
  if (!finder.has_rounded_images() || positions.empty())
    return columns_of(detail::pairs_of(finder), positions, NeighborPairs::Within::cutoff_and_skin,
                      with_itself, params.executor, columns);
  ColumnFiller filler(finder, with_itself);
  filler.fill(columns(filler.pairs()));
  return filler.pairs();
}

}  // namespace dch

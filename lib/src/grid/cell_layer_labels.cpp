// SPDX-License-Identifier: MIT
//
// What kernels are told of the points of a layer: rounded coordinates, what cutoffs go by, who is a ghost.
#include <algorithm>

#include "geometry/metric.hpp"
#include "grid/cell_layer.hpp"

namespace dch::detail {
namespace {

constexpr std::int32_t kAhead = 24;  ///< points whose positions, in no cache, are asked for before their turn

}  // namespace

void CellLayer::quantize(Span<const Vec3> positions, const Box& box, const CellRounding& rounding,
                         const ParticleLabels& labels, Executor* executor) {
  if (!(rounding_ == rounding)) {
    rounding_ = {};
    round_coordinates(positions, box, rounding, executor);
    rounding_ = rounding;
  }
  tag_.resize(labels.by == CutoffBy::one_cutoff ? 0 : static_cast<std::size_t>(size_) + kChunk);
  const double per_unit = 1 / rounding.unit;
  for (std::int32_t place = 0; place < size_ && !tag_.empty(); ++place)
    tag_[place] = tag_of(labels, static_cast<std::size_t>(id_[place]), per_unit);
}

void CellLayer::quantize(const RoundedParticles& rounded, Executor* executor) {
  rounding_ = {};
  tag_.resize(rounded.have_tags() ? static_cast<std::size_t>(size_) + kChunk : 0);
  for_ranges(executor, size_, [&](std::int32_t begin, std::int32_t end) {
    std::int16_t *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
    std::int16_t* const tag = tag_.empty() ? nullptr : tag_.data();
    const std::int32_t* const id = id_.data();
    for (std::int32_t place = begin; place < end; ++place) {
      const RoundedParticle particle = rounded[id[place]];
      x[place] = particle.at[0];
      y[place] = particle.at[1];
      z[place] = particle.at[2];
      if (tag != nullptr) tag[place] = particle.tag;
    }
  });
  rounding_ = rounded.rounding();
}

void CellLayer::round_coordinates(Span<const Vec3> positions, const Box& box, const CellRounding& rounding,
                                  Executor* executor) {
  with_metric(box, [&](const auto& metric) {
    for_ranges(executor, size_, [&](std::int32_t begin, std::int32_t end) {
      const auto own_metric = metric;
      std::int16_t *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
      const std::int32_t* const id = id_.data();
      const CellRounder round(rounding);
      for (std::int32_t place = begin; place < end; ++place) {
        __builtin_prefetch(&positions[static_cast<std::size_t>(id[std::min(place + kAhead, end - 1)])]);
        const auto [rx, ry, rz] = round(own_metric.wrap(positions[static_cast<std::size_t>(id[place])]));
        x[place] = rx;
        y[place] = ry;
        z[place] = rz;
      }
    });
  });
}

void CellLayer::find_ghosts(std::int32_t first_ghost) {
  owned_.clear();
  if (first_ghost < 0) return;
  owned_.assign(static_cast<std::size_t>(cells()), 0);
  for (std::int32_t cell = 0; cell < cells(); ++cell) {
    const Run points = points_of(cell);
    for (std::int32_t place = points.begin; place < points.end; ++place)
      owned_[cell] |= id_[place] < first_ghost;
  }
}

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#include "size_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "block_span.hpp"

namespace dch::bench {

namespace {

/// Largest difference of coordinates in units, below 2^15.
constexpr double kMaxUnits = 32000;
/// The shift that makes units of side / 2^16.
constexpr int kWholeBox = 16;
/// Coordinates are cut off to whole units, so a difference is off by less than one along each axis.
const double kCoordinateBlur = std::sqrt(3.0);

}  // namespace

void SizeGrid::Store::make_room(std::size_t count) {
  if (word.size() >= count) return;
  for (auto* axis : {&x, &y, &z}) axis->resize(count + count / 2);
  word.resize(count + count / 2);
}

SizeGrid::SizeGrid(Span<const double> radii, double skin, const Box& box, double level_ratio,
                   double cell_width)
    : radii_(radii), skin_(skin), side_(box.vector(0).x) {
  if (box != Box::orthorhombic({side_, side_, side_}))
    throw std::invalid_argument("SizeGrid: the box is no periodic cube");
  if (radii.size() > static_cast<std::size_t>(kMaxParticles))
    throw std::invalid_argument("SizeGrid: too many particles");
  std::vector<std::int32_t> order(radii.size());
  std::iota(order.begin(), order.end(), 0);
  const auto radius = [&](std::int32_t i) { return radii[static_cast<std::size_t>(i)]; };
  // In the order of their numbers within a layer, so that positions are read as they lie in memory.
  const double smallest = *std::min_element(radii.begin(), radii.end());
  largest_ = *std::max_element(radii.begin(), radii.end());
  per_code_ = largest_ / kMaxCode;
  for (double from = smallest; from <= largest_; from *= level_ratio) {
    std::vector<std::int32_t> members;
    std::copy_if(order.begin(), order.end(), std::back_inserter(members),
                 [&](std::int32_t i) { return radius(i) >= from && radius(i) < from * level_ratio; });
    if (members.empty()) continue;
    const double most = radius(*std::max_element(members.begin(), members.end(),
                                                 [&](auto a, auto b) { return radius(a) < radius(b); }));
    layers_.emplace_back().set_up(std::move(members), radii, largest_, side_, cell_width * (2 * most + skin),
                                  skin);
    fit_units(layers_.size() - 1);
  }
}

/// The finest units of side / 2^k in which no difference that a test takes overflows. In units of side / 2^16
/// none does, since differences wrap at the period of the box.
void SizeGrid::fit_units(std::size_t which) {
  Layer& layer = layers_[which];
  const double own = layer.is_coarse() ? 0 : layer.width, distance = 2 * layer.most + skin_;
  double longest = own + distance + layer.width;
  for (std::size_t b = 0; b < which; ++b) {
    const double reach = layer.most + layers_[b].most + skin_, cell = layers_[b].width;
    // Where the cells around a box are all there are, candidates come from anywhere.
    const bool everywhere = own + 2 * (reach + cell) >= side_;
    longest = std::max(longest, everywhere ? side_ : own + reach + cell);
  }
  layer.shift = 0;
  const auto unit = [&] { return std::ldexp(side_, layer.shift - 32); };
  while (layer.shift < kWholeBox && longest > kMaxUnits * unit()) ++layer.shift;
  layer.unit = unit();
  layer.blur = kCoordinateBlur;
  if (which > 0 || layer.least < layer.most) layer.blur += 1 + per_code_ / 2 / layer.unit;
}

/// Half the width of the range of squared distances that the integers leave open.
std::int16_t SizeGrid::band(const Layer& layer) const {
  const double s = (2 * layer.most + skin_) / layer.unit;
  return static_cast<std::int16_t>(
      std::min(32767.0, std::ceil((2 * s + layer.blur) * layer.blur / 0x1p15) + 2));
}

/// Squared distances that may be within `distance` are below this.
std::int16_t SizeGrid::limit(const Layer& layer, double distance) const {
  const double s = distance / layer.unit + layer.blur;
  return static_cast<std::int16_t>(std::min(32767.0, std::ceil(s * s / 0x1p15) + 2));
}

void SizeGrid::list(Span<const Vec3> positions, const Box& box, NeighborList& out) {
  kernels_ = &frozen_kernels(instruction_set());
  out.kind = ListKind::half;
  out.first.assign(1, 0);
  out.particle.clear();
  out.j.resize(out.j.capacity());
  for (Layer& layer : layers_) layer.sort(positions);
  const Scene scene{positions, box, out};
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (layers_[k].is_coarse()) {
      for (std::int32_t place = 0; place < layers_[k].size(); ++place) rows_of_particle(k, place, scene);
    } else {
      for (std::int32_t cell = 0; cell < layers_[k].cell_count(); ++cell) rows_of_cell(k, cell, scene);
    }
  }
}

void SizeGrid::append(const Layer& layer, const SizeLayer& from, Run run) {
  const std::int32_t length = run.end - run.begin;
  if (length <= 0) return;
  around_.make_room(static_cast<std::size_t>(count_ + length + kChunk));
  const auto begin = static_cast<std::size_t>(run.begin);
  copy_shortened(
      {from.x.data() + begin, from.y.data() + begin, from.z.data() + begin, from.word.data() + begin},
      layer.shift, length, around_.at(count_));
  count_ += length;
}

void SizeGrid::rows_of_cell(std::size_t which, std::int32_t cell, const Scene& scene) {
  const Layer& layer = layers_[which];
  const Run own = layer.particles(cell);
  if (own.begin == own.end) return;
  const SizeLayer::Cell at = layer.cell(cell);
  count_ = 0;
  append(layer, layer, own);
  layer.half_stencil(at, [&](Run run) { append(layer, layer, run); });
  count_ = kernels_->filter(span_of(around_.at(0), own.end - own.begin), limit(layer, 2 * layer.most + skin_),
                            around_.at(0), count_, around_.at(0));
  const Vec3 low{at[0] * layer.width, at[1] * layer.width, at[2] * layer.width};
  add_smaller(which, own, low, low + Vec3{layer.width, layer.width, layer.width});
  for (std::int32_t begin = own.begin; begin < own.end; begin += kBlock)
    rows_of_block(layer, {begin, std::min(begin + kBlock, own.end)}, begin - own.begin, scene);
}

/// For the few particles that are large compared with the box: pairs with each other are found one by one.
void SizeGrid::rows_of_particle(std::size_t which, std::int32_t place, const Scene& scene) {
  const Layer& layer = layers_[which];
  count_ = 0;
  append(layer, layer, {place, place + 1});
  const auto length = [&](std::uint32_t fraction) { return std::ldexp(side_ * fraction, -32); };
  const auto p = static_cast<std::size_t>(place);
  const Vec3 at{length(layer.x[p]), length(layer.y[p]), length(layer.z[p])};
  add_smaller(which, {place, place + 1}, at, at);
  rows_of_block(layer, {place, place + 1}, 0, scene);
  const auto number = [&](std::int32_t k) {
    return layer.word[static_cast<std::size_t>(k)] & (kMaxParticles - 1);
  };
  for (std::int32_t other = place + 1; other < layer.size(); ++other) {
    if (!in_list(number(place), number(other), scene)) continue;
    const auto written = static_cast<std::size_t>(scene.out.first.back()++);
    if (scene.out.j.size() <= written) scene.out.j.resize(2 * written + 1);
    scene.out.j[written] = number(other);
  }
}

/// The particles of finer layers near the box around some own ones, which stand first among the candidates.
void SizeGrid::add_smaller(std::size_t which, Run own, Vec3 low, Vec3 high) {
  const Layer& layer = layers_[which];
  const detail::BlockSpan span = span_of(around_.at(0), own.end - own.begin);
  for (std::size_t b = 0; b < which; ++b) {
    const double distance = layer.most + layers_[b].most + skin_;
    const std::int32_t before = count_;
    layers_[b].near_box(low, high, distance, [&](Run run) { append(layer, layers_[b], run); });
    count_ = before + kernels_->filter(span, limit(layer, distance), around_.at(before), count_ - before,
                                       around_.at(before));
  }
}

void SizeGrid::rows_of_block(const Layer& layer, Run block, std::int32_t before, const Scene& scene) {
  const std::int32_t rows = block.end - block.begin;
  const auto first = static_cast<std::size_t>(block.begin);
  BlockPoints points{};
  // The first candidates are the block's own points.
  const detail::Candidates own = around_.at(before);
  std::copy_n(own.x, rows, points.x);
  std::copy_n(own.y, rows, points.y);
  std::copy_n(own.z, rows, points.z);
  std::int16_t reach[kBlock] = {};
  for (std::int32_t row = 0; row < rows; ++row) {
    const std::int32_t i = layer.word[first + static_cast<std::size_t>(row)] & (kMaxParticles - 1);
    reach[row] =
        static_cast<std::int16_t>(std::lround((radii_[static_cast<std::size_t>(i)] + skin_) / layer.unit));
  }
  near_.make_room(static_cast<std::size_t>(count_ - before + kChunk));
  const std::int32_t count = kernels_->filter(span_of({points.x, points.y, points.z, nullptr}, rows),
                                              limit(layer, 2 * layer.most + skin_), around_.at(before),
                                              count_ - before, near_.at(0));
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  decide(block, test_block(layer, points, reach, count), chunks, layer, scene);
  NeighborList& out = scene.out;
  auto written = static_cast<std::size_t>(out.first.back());
  const std::size_t most = written + static_cast<std::size_t>(kBlock * kChunk * chunks + kChunk);
  if (out.j.size() < most) out.j.resize(most + most / 4);
  for (std::int32_t row = 0; row < rows; ++row) {
    std::uint32_t* const mask = mask_.data() + row * chunks;
    mask[0] &= ~0u << (row + 1);
    written +=
        static_cast<std::size_t>(kernels_->compress(mask, chunks, number_.data(), out.j.data() + written));
    out.particle.push_back(number_[static_cast<std::size_t>(row)]);
    out.first.push_back(static_cast<std::int64_t>(written));
  }
}

/// Tests a block against the candidates in near_. Returns how many entries of unsettled_ are left open.
std::int32_t SizeGrid::test_block(const Layer& layer, const BlockPoints& points, const std::int16_t* reach,
                                  std::int32_t count) {
  const std::int32_t chunks = (count + kChunk - 1) / kChunk;
  const auto room = static_cast<std::size_t>(kBlock * (chunks + 1));
  if (mask_.size() < room) {
    mask_.resize(room);
    unsettled_.resize(room);
  }
  if (number_.size() < near_.word.size()) {
    number_.resize(near_.word.size());
    radius_.resize(near_.word.size());
  }
  unpack(near_.word.data(), static_cast<float>(per_code_ / layer.unit), count, number_.data(),
         radius_.data());
  // The library's test must not meet a difference of half a period, which units of side / 2^16 let happen.
  const bool one_distance = layer.least == layer.most && &layer == layers_.data() && layer.shift < kWholeBox;
  if (!one_distance)
    return test_radii(points, reach, near_.at(0), radius_.data(), count, band(layer), mask_.data(), chunks,
                      unsettled_.data());
  const double s = (2 * layer.most + skin_) / layer.unit;
  const auto limits = [&](double by) {
    return static_cast<std::int16_t>(std::clamp(std::floor(s * s / 0x1p15 + by) + 1, 0.0, 32767.0));
  };
  return kernels_->test(points, near_.at(0), count, limits(-band(layer)), limits(band(layer)), mask_.data(),
                        chunks, unsettled_.data());
}

/// Decides in double what the integers left open.
void SizeGrid::decide(Run block, std::int32_t open, std::int32_t chunks, const Layer& layer,
                      const Scene& scene) {
  for (std::int32_t u = 0; u < open; ++u) {
    const auto [row, chunk, lanes] = unsettled_[static_cast<std::size_t>(u)];
    if (block.begin + row >= block.end) continue;
    const std::int32_t i = layer.word[static_cast<std::size_t>(block.begin + row)] & (kMaxParticles - 1);
    for (std::uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      const std::int32_t j = number_[static_cast<std::size_t>(chunk * kChunk + lane)];
      if (j != i && in_list(i, j, scene)) mask_[static_cast<std::size_t>(row * chunks + chunk)] |= 1u << lane;
    }
  }
}

bool SizeGrid::in_list(std::int32_t i, std::int32_t j, const Scene& scene) const {
  const auto a = static_cast<std::size_t>(std::min(i, j)), b = static_cast<std::size_t>(std::max(i, j));
  const double contact = radii_[a] + radii_[b] + skin_;
  return scene.box.distance2(scene.positions[a], scene.positions[b]) <= contact * contact;
}

std::size_t SizeGrid::memory_bytes() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t bytes = bytes_of(number_) + bytes_of(radius_) + bytes_of(mask_) + bytes_of(unsettled_);
  for (const Layer& layer : layers_) bytes += layer.memory_bytes();
  for (const Store* store : {&around_, &near_}) bytes += 3 * bytes_of(store->x) + bytes_of(store->word);
  return bytes;
}

}  // namespace dch::bench

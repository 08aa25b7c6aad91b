// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <dch/base/instruction_set.hpp>
#include <dch/base/span.hpp>
#include <dch/geometry/box.hpp>
#include <dch/lists/list_maker.hpp>

#include "grid/cell_layer.hpp"
#include "grid/stencil.hpp"
#include "leaves/own_blocks.hpp"
#include "lists/candidate_store.hpp"
#include "lists/row_request.hpp"

namespace dch::detail {

/// What rows are found in, the same for all cells of a layer.
struct CellScene {
  /// Points that may be near those of the layer: finer ones, whose points any cell may meet.
  struct Near {
    CellLayer* layer;
    double reach;  ///< of its points and those of the rows [length]
  };
  CellLayer& rows;
  std::vector<StencilRow> stencil;
  std::vector<Near> finer;
  Span<const Vec3> positions;
  const Box& box;
  double unit;                       ///< of all coordinates [length]
  double per_unit;                   ///< 1 / unit
  bool has_ghosts;                   ///< whether layers know the cells that hold none but ghosts
  std::vector<RowRequest> requests;  ///< one a list, the one with the largest radius first
};

/// Gathers the points near one cell after the other: its own, those of the cells around it, and those of
/// finer layers.
class CellCandidates {
 public:
  /// To be called before the first cell of a list.
  void use(InstructionSet set) { kernels_ = &list_kernels(set); }

  /// Calls f(own, candidates, count) for parts of a cell, few blocks each: the candidates that may be within
  /// reach of the first request are the part's own points, in order, then those of the cell's parts after it,
  /// then others.
  template <class F>
  void for_each_part(const CellScene& scene, std::int32_t cell, const F& f) {
    const CellLayer::Run own = scene.rows.points_of(cell);
    for_each_group(
        0, rounded_up(own.size(), kBlock) / kBlock, kPart, [&](std::int32_t first, std::int32_t last) {
          const CellLayer::Run part{own.begin + first * kBlock, std::min(own.end, own.begin + last * kBlock)};
          const OwnBlocks blocks = take_blocks(scene, cell, part);
          collect(scene, cell, blocks, part);
          f(blocks, around_.at(0), count_);
        });
  }

  /// For all cells so far.
  const ListWork& work() const { return work_; }
  std::size_t memory_bytes() const { return around_.memory_bytes(); }

 private:
  static constexpr std::int32_t kPart = 5;  ///< most blocks in one

  OwnBlocks take_blocks(const CellScene& scene, std::int32_t cell, CellLayer::Run part);
  void collect(const CellScene& scene, std::int32_t cell, const OwnBlocks& own, CellLayer::Run part);
  void collect_finer(const CellScene& scene, const CellScene::Near& near, CellLayer::Run part);
  void append_row(const CellScene& scene, CellLayer& layer, std::int32_t y, std::int32_t z,
                  std::int32_t first, std::int32_t last);
  /// What brings points of one period to those of another [units].
  struct Shift {
    bool is_zero = true;
    std::array<std::int16_t, 3> by{};
  };
  static Shift shift_of(const CellScene& scene, Vec3 by);
  void append_run(const CellScene& scene, CellLayer& layer, CellLayer::Run run, const Shift& shift);

  const ListKernels* kernels_ = nullptr;
  ListWork work_;
  std::array<BlockPoints, kPart> points_;
  std::array<BlockSpan, kPart> spans_;
  std::array<OfLanes<std::int32_t>, kPart> particle_;
  std::array<OfLanes<std::int16_t>, kPart> tags_;
  std::array<std::uint8_t, kPart> in_block_;
  BlockSpan span_{};         ///< around the part
  std::int16_t size_ = 0;    ///< the largest tag of the part
  bool only_owned_ = false;  ///< whether the part's points are all ghosts, and meet no others
  CandidateStore around_;
  std::int32_t count_ = 0;  ///< of around_
};

}  // namespace dch::detail

// SPDX-License-Identifier: MIT
#include "grid/grid_rows.hpp"

#include <algorithm>

#include "grid/stencil.hpp"
#include "leaves/rounding.hpp"

namespace dch::detail {

namespace {

/// Pairs of a piece, about: few enough to stay in a cache until they are looked at.
constexpr std::int64_t kPairsOfPiece = 1 << 14;

}  // namespace

void GridRows::find(const GridScene& scene, const std::vector<const PairFilter*>& filters,
                    const std::vector<NeighborList*>& out) {
  for (NeighborList* list : out) start_rows(*list);
  append(scene, filters, out, [](const std::vector<RowRequest>&, NeighborList*) {});
}

void GridRows::find_in_pieces(const GridScene& scene, const PairFilter& filter,
                              const std::function<void(const NeighborList&)>& use) {
  NeighborList piece;
  start_rows(piece);
  append(scene, {&filter}, {&piece}, [&](const std::vector<RowRequest>& requests, NeighborList* list) {
    if (list->first.back() < kPairsOfPiece) return;
    const double margin = filter.params().superset ? requests.front().limits.margin : 0;
    list->margin = margin;
    use(*list);
    start_rows(*list);
    list->margin = margin;
  });
  if (piece.size() > 0) use(piece);  // what was left of all threads
}

void GridRows::append(const GridScene& scene, const std::vector<const PairFilter*>& filters,
                      const std::vector<NeighborList*>& out, const Appended& appended) {
  const ListParams& params = filters.front()->params();
  const ParticleLabels labels{filters.front()->by(), params.radii, params.types, params.first_ghost};
  const Vec3 origin = scene.positions.empty() ? Vec3{} : scene.box.wrap(scene.positions[0]);
  for (std::size_t s = 0; s < scene.layers.size(); ++s) {
    CellLayer& rows = *scene.layers[s];
    if (rows.size() == 0) continue;
    const double own_reach = scene.reach_of(s, s);
    CellScene cells{rows, half_stencil(rows.layout(), own_reach), {}, scene.positions, scene.box, 0, 0, false,
                    {}};
    double widest = widest_in(rows.layout(), cells.stencil), farthest = own_reach;
    for (std::size_t a = 0; a < s; ++a) {
      const double reach = scene.reach_of(s, a);
      if (reach == 0) continue;
      cells.finer.push_back({scene.layers[a], reach});
      widest = std::max(
          widest, reach + longest(rows.layout().extent()) + longest(scene.layers[a]->layout().extent()));
      farthest = std::max(farthest, reach);
    }
    cells.unit = finest_unit(widest);
    cells.per_unit = 1 / cells.unit;
    cells.has_ghosts = params.first_ghost >= 0;
    round_layers(scene, s, {origin, cells.unit}, labels);
    for (std::size_t a = 0; a <= s; ++a) scene.layers[a]->find_ghosts(params.first_ghost);
    for (std::size_t r = 0; r < out.size(); ++r) {
      cells.requests.push_back({filters[r], ListLimits(*filters[r], cells.unit, farthest, scene.error)});
      if (filters[r]->params().superset)
        out[r]->margin = std::max(out[r]->margin, cells.requests.back().limits.margin);
    }
    parts_.find(scene.executor, out,
                [&](CellCandidates& near, RowFinder& finder, NeighborList* lists, int share, int shares) {
                  const std::int32_t last =
                      share + 1 == shares ? rows.cells() : rows.first_cell_of_share(share + 1, shares);
                  const std::int32_t first = rows.first_cell_of_share(share, shares);
                  for (std::int32_t cell = first; cell < last; ++cell) {
                    finder.note_progress(cell - first, last - first);
                    near.for_each_part(
                        cells, cell, [&](const OwnBlocks& own, const Candidates& around, std::int32_t count) {
                          finder.append_rows(cells.requests, own, around, count, lists);
                        });
                    appended(cells.requests, lists);
                  }
                });
  }
}

/// Those that the rows of a layer are made of.
void GridRows::round_layers(const GridScene& scene, std::size_t rows, const CellRounding& rounding,
                            const ParticleLabels& labels) {
  if (rows == 0)
    return scene.layers[0]->quantize(scene.positions, scene.box, rounding, labels, scene.executor);
  rounded_.round(scene.positions, scene.box, scene.layers[rows]->layout(), rounding, labels, scene.executor);
  for (std::size_t a = 0; a <= rows; ++a) scene.layers[a]->quantize(rounded_, scene.executor);
}

}  // namespace dch::detail

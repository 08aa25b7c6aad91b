// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "report/query_rows.hpp"

namespace dch::cli {
namespace {

std::string spread_text(const LengthSpread& spread, const std::string& unit) {
  if (spread.count() == 0) return "none: no frame has so many atoms";
  return fmt::format("min {}, mean {}, max {} {}", readable(spread.least()), readable(spread.mean()),
                     readable(spread.most()), unit_suffix(unit));
}

std::string closest_text(const QueryReport& report) {
  const QueryFrame* const frame = report.closest();
  if (!frame) return "none: no frame has two atoms";
  return fmt::format("{} {}: the ids {} and {} in frame {}", readable(frame->closest->distance),
                     unit_suffix(report.unit), frame->closest->i, frame->closest->j, frame->frame);
}

std::string clusters_text(const QueryReport& report, std::size_t cutoff) {
  std::int64_t clusters = 0, largest = 0;
  for (const QueryFrame& frame : report.frames) {
    clusters += frame.clusters[cutoff];
    largest = std::max(largest, frame.largest[cutoff]);
  }
  return fmt::format("mean {} a frame, the largest of {}",
                     readable(static_cast<double>(clusters) / static_cast<double>(report.frames.size())),
                     counted(largest, "atom"));
}

std::string cost_text(const QueryReport& report) {
  double read = 0, update = 0, nearest = 0, clusters = 0;
  for (const QueryFrame& frame : report.frames) {
    read += frame.read_ms;
    update += frame.update_ms;
    nearest += frame.nearest_ms;
    clusters += frame.clusters_ms;
  }
  const auto frames = static_cast<double>(report.frames.size());
  const std::string threads = report.threads > 1 ? fmt::format(" ({} threads)", report.threads) : "";
  std::string text = fmt::format("read {}, update {}, nearest {}{}", readable(read / frames),
                                 readable(update / frames), readable(nearest / frames), threads);
  if (!report.cutoffs.empty()) text += fmt::format(", clusters {}", readable(clusters / frames));
  return text;
}

}  // namespace

std::vector<Row> query_rows(const QueryReport& report) {
  std::vector<Row> rows = {{"file", fmt::format("{} ({})", report.file, report.format)},
                           {"unit of length", report.unit},
                           {"frames", grouped(static_cast<std::int64_t>(report.frames.size()))},
                           {"atoms", count_text(report.fewest_atoms, report.most_atoms)},
                           {"box", box_text(report)},
                           {"closest pair", closest_text(report)},
                           {"nearest", spread_text(report.nearest.front(), report.unit)}};
  if (report.nearest.size() > 1) {
    rows.push_back({fmt::format("nearest no. {}", report.nearest.size()),
                    spread_text(report.nearest.back(), report.unit)});
  }
  for (std::size_t k = 0; k < report.cutoffs.size(); ++k) {
    rows.push_back({fmt::format("clusters at {}", readable(report.cutoffs[k])), clusters_text(report, k)});
  }
  rows.push_back({"ms a frame", cost_text(report)});
  return rows;
}

std::string render_table(const QueryReport& report) { return render_rows(query_rows(report)); }

}  // namespace dch::cli

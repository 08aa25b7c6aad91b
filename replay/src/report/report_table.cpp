// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

#include "base/number_text.hpp"
#include "report/replay_report.hpp"
#include "report/report_rows.hpp"

namespace dch::cli {
namespace {

std::string levels_text(const ReplayReport& report) {
  std::vector<std::string> sizes;
  for (const LevelInfo& level : report.levels) sizes.push_back(grouped(level.nodes));
  return fmt::format("{} (nodes after the last frame: {})", report.levels.size(), fmt::join(sizes, ", "));
}

std::string exclusion_text(const ExclusionRecord& exclusions) {
  const std::string bonds = fmt::format("{} from {}", counted(exclusions.bonds, "bond"), exclusions.source);
  if (exclusions.rule.empty()) return fmt::format("none ({})", bonds);
  return fmt::format("{}: {} ({})", exclusions.rule == "1-2" ? exclusions.rule : "1-2 to " + exclusions.rule,
                     counted(exclusions.pairs, "pair"), bonds);
}

std::string intervals_text(const VerifyResult& verify) {
  if (verify.intervals.empty()) return "";
  return ", hidden contacts of " + counted(static_cast<std::int64_t>(verify.intervals.size()), "interval");
}

std::string verify_text(const VerifyResult& verify) {
  const auto frames = static_cast<std::int64_t>(verify.frames.size());
  switch (verify.mode) {
    case VerifyMode::all: {
      std::string text = fmt::format("all pairs of {}", counted(frames, "frame"));
      if (verify.structure_checks > 0)
        text += fmt::format(", hierarchy of {}", grouped(verify.structure_checks));
      text += intervals_text(verify);
      return text;
    }
    case VerifyMode::sample:
      return fmt::format("{} in {}{} (seed {})", counted(verify.rows, "atom"), counted(frames, "frame"),
                         intervals_text(verify), verify.seed);
    case VerifyMode::none:
      break;
  }
  return "none (--verify sample or --verify all compares the lists with all pairs)";
}

std::string mismatch_text(const VerifyResult& verify) {
  return verify.mode == VerifyMode::none ? "not looked for" : grouped(verify.mismatches);
}

std::string cost_text(const ReplayReport& report, const ReplayTotals& totals) {
  const auto frames = static_cast<double>(report.frames.size());
  return fmt::format("read {}, maintain {}, list {}", readable(totals.read_ms / frames),
                     readable(totals.maintain_ms / frames), readable(totals.list_ms / frames));
}

void add_between_rows(const BetweenReport& between, const std::string& unit, std::vector<Row>& rows) {
  const IntervalRecord totals = between.totals();
  const auto intervals = static_cast<std::int64_t>(between.intervals.size());
  rows.push_back({"between frames", fmt::format("{} that no frame shows; {} come, {} go ({})",
                                                counted(totals.hidden, "contact"), grouped(totals.come),
                                                grouped(totals.go), counted(totals.events(), "event"))});
  if (between.closest) {
    rows.push_back({"closest hidden",
                    fmt::format("{} {}: the ids {} and {} between frames {} and {}",
                                readable(between.closest->closest), unit_suffix(unit), between.closest->i,
                                between.closest->j, between.closest->frame, between.closest->next_frame)});
  }
  std::vector<std::string> left_out;
  if (between.followed() < intervals) {
    const auto first =
        std::find_if(between.intervals.begin(), between.intervals.end(),
                     [](const IntervalRecord& interval) { return !interval.undetermined.empty(); });
    left_out.push_back(fmt::format("{} of {} (the first after frame {}: {})",
                                   grouped(intervals - between.followed()), counted(intervals, "interval"),
                                   first->frame, first->undetermined));
  }
  if (totals.undetermined_atoms > 0)
    left_out.push_back(
        fmt::format("{} that moved half a box or more", counted(totals.undetermined_atoms, "atom")));
  if (totals.unmatched_atoms > 0)
    left_out.push_back(fmt::format("{} in one frame alone", counted(totals.unmatched_atoms, "atom")));
  if (!left_out.empty()) rows.push_back({"not followed", fmt::format("{}", fmt::join(left_out, "; "))});
  rows.push_back({"ms an interval", readable(totals.ms / static_cast<double>(intervals))});
}

}  // namespace

std::string engine_text(const ReplayReport& report) {
  const EngineOptions& engine = report.engine;
  const std::string threads = report.threads > 1 ? fmt::format(", {} threads", report.threads) : "";
  switch (engine.kind) {
    case EngineKind::cell:
      return "cell list, built at every update";
    case EngineKind::allpairs:
      return "all pairs, no structure";
    case EngineKind::grid:
      return "grid, built at every update" + threads;
    case EngineKind::automatic:
      return fmt::format("auto ({}), policy {}{}", report.choice, to_string(engine.policy), threads);
    case EngineKind::dch:
      break;
  }
  return fmt::format("dch, policy {}{}", to_string(engine.policy), threads);
}

std::string list_text(const ReplayReport& report) {
  return fmt::format("{}, cutoff {}{} {}", to_string(report.list_kind), report.cutoff,
                     report.skin > 0 ? fmt::format(" + skin {}", report.skin) : "", unit_suffix(report.unit));
}

std::vector<Row> report_rows(const ReplayReport& report) {
  const ReplayTotals totals = report.totals();
  std::vector<Row> rows{{"file", fmt::format("{} ({})", report.file, report.format)},
                        {"unit of length", report.unit},
                        {"engine", engine_text(report)},
                        {"list", list_text(report)},
                        {"frames", grouped(static_cast<std::int64_t>(report.frames.size()))},
                        {"atoms", count_text(report.fewest_atoms, report.most_atoms)},
                        {"box", box_text(report)}};
  if (!report.exclusions.source.empty()) rows.push_back({"excluded", exclusion_text(report.exclusions)});
  rows.push_back({"pairs a frame", fmt::format("min {}, mean {}, max {}", grouped(totals.pairs_min),
                                               readable(totals.pairs_mean), grouped(totals.pairs_max))});
  rows.push_back({"list rebuilds", grouped(totals.list_rebuilds)});
  rows.push_back(
      {"structure", fmt::format("{}, {}, {} without either", counted(totals.repairs, "repair"),
                                counted(totals.rebuilds, "rebuild"), counted(totals.refreshes, "update"))});
  if (!report.levels.empty()) {
    rows.push_back({"promotions", grouped(totals.promotions)});
    rows.push_back({"demotions", grouped(totals.demotions)});
    rows.push_back({"levels", levels_text(report)});
  }
  rows.push_back({"ms a frame", cost_text(report, totals)});
  if (report.between) add_between_rows(*report.between, report.unit, rows);
  rows.push_back({"verified", verify_text(report.verify)});
  rows.push_back({"mismatches", mismatch_text(report.verify)});
  return rows;
}

std::string render_rows(const std::vector<Row>& rows) {
  std::string table;
  for (const Row& row : rows) table += fmt::format("  {:<15} {}\n", row.name, row.value);
  return table;
}

std::string render_table(const ReplayReport& report) { return render_rows(report_rows(report)); }

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "report/contact_rows.hpp"

namespace dch::cli {
namespace {

std::string chains_text(const ContactReport& report) {
  std::string text = counted(report.chains, "chain");
  if (report.rings > 0) text += fmt::format(" ({})", counted(report.rings, "ring"));
  return text + fmt::format(" of {} beads, {} in all (from {})",
                            count_text(report.shortest_chain, report.longest_chain), grouped(report.beads),
                            report.topology);
}

std::string radii_text(const ContactReport& report) {
  if (report.largest_radius == 0) return "0 (distances are those of the centers)";
  if (report.smallest_radius == report.largest_radius) {
    return fmt::format("{} {}", report.largest_radius, unit_suffix(report.unit));
  }
  return fmt::format("{} to {} {}", report.smallest_radius, report.largest_radius, unit_suffix(report.unit));
}

std::string contact_text(const ContactReport& report) {
  std::string text = fmt::format("surfaces at most {} {} apart", report.query.gap, unit_suffix(report.unit));
  const std::string pairs = pairs_text(report.query);
  if (pairs == "within") text += ", within chains alone";
  if (pairs == "between") return text + ", between chains alone";
  return text + fmt::format(", more than {} between", counted(report.query.skip_bonds, "bond"));
}

std::string spread_text(const ContactReport& report) {
  const FrameSpread spread = report.contacts();
  return fmt::format("min {}, mean {}, max {}", grouped(spread.least), readable(spread.mean),
                     grouped(spread.most));
}

std::string events_text(const EventSummary& events) {
  return fmt::format("{}, {} there in the first frame, {} in the last", grouped(events.events()),
                     grouped(events.begun_before()), grouped(events.not_ended()));
}

std::string duration_text(const ContactReport& report) {
  const EventSummary& events = report.events;
  const char* const unit = report.has_times ? "the file's time" : "time steps";
  const std::string longest = fmt::format("longest {}", readable(events.longest()));
  if (events.complete() == 0) return fmt::format("{} ({}); none began and ended within", longest, unit);
  return fmt::format("mean {} of {} that began and ended within, {} ({})", readable(events.mean_duration()),
                     grouped(events.complete()), longest, unit);
}

std::string probability_text(const ContactReport& report) {
  const auto ranges = report.probability.ranges(kRangesPerDecade);
  const auto text = [](const necklace::SeparationRange& range) {
    return fmt::format("{} at s = {}", readable(range.probability), count_text(range.first, range.last));
  };
  if (ranges.empty()) return "none: no two beads are asked for";
  if (ranges.size() == 1) return text(ranges.front());
  return text(ranges.front()) + ", " + text(ranges.back());
}

std::string choice_text(const ContactReport& report) {
  return fmt::format("wrapped hierarchy in {}, DCH in {}; {}",
                     counted(report.frames_by(necklace::Structure::wrapped), "frame"),
                     grouped(report.frames_by(necklace::Structure::dch)), report.choice.reason);
}

std::string structure_text(const ContactReport& report) {
  const auto& stats = report.structure;
  const auto checked = static_cast<double>(stats.cages_checked);
  const double part = checked > 0 ? 100 * static_cast<double>(stats.basis_changes) / checked : 0;
  return fmt::format("{}, {}, {} % of the bases changed in an update", counted(report.cages, "cage"),
                     counted(stats.updates, "update"), readable(part));
}

std::string cost_text(const ContactReport& report) {
  double read = 0, update = 0, search = 0, follow = 0;
  for (const ContactFrame& frame : report.frames) {
    read += frame.read_ms;
    update += frame.update_ms;
    search += frame.search_ms;
    follow += frame.follow_ms;
  }
  const auto frames = static_cast<double>(report.frames.size());
  const std::string threads = report.threads > 1 ? fmt::format(" ({} threads)", report.threads) : "";
  return fmt::format("read {}, update {}, search {}{}, follow {}", readable(read / frames),
                     readable(update / frames), readable(search / frames), threads,
                     readable(follow / frames));
}

}  // namespace

std::vector<Row> contact_rows(const ContactReport& report) {
  return {{"file", fmt::format("{} ({})", report.file, report.format)},
          {"unit of length", report.unit},
          {"frames", grouped(static_cast<std::int64_t>(report.frames.size()))},
          {"atoms", count_text(report.fewest_atoms, report.most_atoms)},
          {"chains", chains_text(report)},
          {"radii", radii_text(report)},
          {"box", box_text(report)},
          {"contacts", contact_text(report)},
          {"in a frame", spread_text(report)},
          {"events", events_text(report.events)},
          {"duration", duration_text(report)},
          {"P(s)", probability_text(report)},
          {"map", counted(static_cast<std::int64_t>(report.map.bins()), "bin")},
          {"found by", choice_text(report)},
          {"structure", structure_text(report)},
          {"ms a frame", cost_text(report)}};
}

std::string render_table(const ContactReport& report) { return render_rows(contact_rows(report)); }

}  // namespace dch::cli

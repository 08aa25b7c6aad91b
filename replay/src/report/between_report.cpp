// SPDX-License-Identifier: MIT
#include "report/between_report.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dch::cli {
namespace {

void count(BetweenReport::Histogram& histogram, double share) {
  const double percent = std::clamp(100 * share, 0.0, static_cast<double>(histogram.size() - 1));
  ++histogram[static_cast<std::size_t>(percent)];
}

}  // namespace

void BetweenReport::add(IntervalRecord record, const std::vector<BetweenContact>& contacts, double cutoff) {
  for (const BetweenContact& contact : contacts) {
    if (!contact.is_hidden) continue;
    count(distances, contact.closest / cutoff);
    count(durations, contact.leaves - contact.enters);
    record.closest = std::min(record.closest.value_or(contact.closest), contact.closest);
    if (closest && closest->closest <= contact.closest) continue;
    closest = Closest{contact, record.frame, record.next_frame};
  }
  intervals.push_back(std::move(record));
}

IntervalRecord BetweenReport::totals() const {
  IntervalRecord sum;
  for (const IntervalRecord& interval : intervals) {
    sum.hidden += interval.hidden;
    sum.come += interval.come;
    sum.go += interval.go;
    sum.undetermined_atoms += interval.undetermined_atoms;
    sum.unmatched_atoms += interval.unmatched_atoms;
    sum.candidates += interval.candidates;
    sum.ms += interval.ms;
  }
  return sum;
}

std::int64_t BetweenReport::followed() const {
  return std::count_if(intervals.begin(), intervals.end(),
                       [](const IntervalRecord& interval) { return interval.undetermined.empty(); });
}

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#include "analysis/between_frames.hpp"

#include <cstddef>

#include "base/stopwatch.hpp"

namespace dch::cli {

bool BetweenFrames::follow(const trajectory::Frame& frame, std::int64_t index, const Exclusions& exclusions) {
  const Stopwatch watch;
  const bool has_last = last_index_ >= 0;
  if (has_last) {
    record_ = {};
    record_.frame = last_index_;
    record_.next_frame = index;
    match(frame);
    find(exclusions);
    record_.ms = watch.milliseconds();
  }
  last_.ids = frame.ids;
  last_.positions = frame.positions;
  last_.box = frame.box;
  last_index_ = index;
  return has_last;
}

/// Atoms stand in ascending order of their ids.
void BetweenFrames::match(const trajectory::Frame& frame) {
  ids_.clear();
  before_.clear();
  after_.clear();
  places_.clear();
  std::size_t then = 0, now = 0;
  while (then < last_.ids.size() && now < frame.ids.size()) {
    const std::int64_t a = last_.ids[then], b = frame.ids[now];
    if (a == b) {
      ids_.push_back(a);
      before_.push_back(last_.positions[then]);
      after_.push_back(frame.positions[now]);
      places_.push_back(static_cast<std::int32_t>(now));
    }
    then += a <= b ? 1 : 0;
    now += b <= a ? 1 : 0;
  }
  record_.unmatched_atoms = static_cast<std::int64_t>(last_.ids.size() + frame.ids.size() - 2 * ids_.size());
  box_before_ = last_.box;
  box_after_ = frame.box;
}

void BetweenFrames::find(const Exclusions& exclusions) {
  const kinetic::PassingContacts& found = contacts_between_.find(before_, box_before_, after_, box_after_);
  record_.undetermined = found.undetermined;
  record_.undetermined_atoms = static_cast<std::int64_t>(found.undetermined_points.size());
  record_.candidates = found.candidates;
  undetermined_ = found.undetermined_points;
  exclusions_ = &exclusions;
  contacts_.clear();
  for (const kinetic::PassingContact& contact : found.contacts) {
    const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
    if (exclusions.excluded(places_[i], places_[j])) continue;
    record_.hidden += contact.is_hidden() ? 1 : 0;
    record_.come += contact.is_shown_after ? 1 : 0;
    record_.go += contact.is_shown_before ? 1 : 0;
    contacts_.push_back(
        {ids_[i], ids_[j], contact.enters, contact.leaves, contact.closest, contact.is_hidden()});
  }
}

Verifier::Interval BetweenFrames::subject() const {
  Verifier::Interval interval;
  interval.frame = record_.frame;
  interval.next_frame = record_.next_frame;
  interval.cutoff = cutoff_;
  interval.ids = ids_;
  interval.before = before_;
  interval.after = after_;
  interval.box_before = &box_before_;
  interval.box_after = &box_after_;
  interval.undetermined = undetermined_;
  interval.contacts = contacts_;
  interval.exclusions = exclusions_;
  interval.places = places_;
  return interval;
}

}  // namespace dch::cli

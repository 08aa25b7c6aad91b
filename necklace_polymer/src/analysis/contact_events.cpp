// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <dch/necklace/contact_events.hpp>

#include "chains/parameter_check.hpp"

namespace dch::necklace {

namespace {

template <class Pair, class OtherPair>
bool in_order(const Pair& a, const OtherPair& b) {
  return a.i != b.i ? a.i < b.i : a.j < b.j;
}

void check_order(Span<const Contact> contacts) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const bool ascends = k == 0 || in_order(contacts[k - 1], contacts[k]);
    if (ascends && contacts[k].i < contacts[k].j) continue;
    throw InvalidParameter("contact " + std::to_string(k) + ", of the beads " +
                           std::to_string(contacts[k].i) + " and " + std::to_string(contacts[k].j) +
                           ", is out of order; contacts have to ascend and to have i < j, as find_contacts() "
                           "gives them");
  }
}

}  // namespace

Span<const ContactEvent> ContactEvents::add(double time, Span<const Contact> contacts) {
  detail::require_parameter(std::isfinite(time),
                            "the time is " + std::to_string(time) + "; it has to be finite");
  detail::require_parameter(frames_ == 0 || time >= time_,
                            "the time is " + std::to_string(time) + ", below that of the frame before, " +
                                std::to_string(time_) + "; take frames in the order of their times");
  check_order(contacts);
  next_.clear();
  ended_.clear();
  auto before = running_.begin();
  for (const Contact& contact : contacts) {
    for (; before != running_.end() && in_order(*before, contact); ++before) ended_.push_back(*before);
    if (before != running_.end() && !in_order(contact, *before)) {
      next_.push_back(*before++);
    } else {
      next_.push_back({contact.i, contact.j, frames_, 0, time, time, frames_ == 0, false});
    }
    ++next_.back().frames;
    next_.back().last = time;
  }
  ended_.insert(ended_.end(), before, running_.end());
  running_.swap(next_);
  ++frames_;
  time_ = time;
  return ended_;
}

std::vector<ContactEvent> ContactEvents::finish() {
  for (ContactEvent& event : running_) event.not_ended = true;
  frames_ = 0;
  return std::exchange(running_, {});
}

}  // namespace dch::necklace

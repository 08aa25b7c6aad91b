// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <dch/base/span.hpp>
#include <dch/necklace/contacts.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// Two beads in contact in frame after frame, from the first to the last without a gap.
struct ContactEvent {
  std::int32_t i = 0, j = 0;   ///< particles, i < j
  std::int64_t first = 0;      ///< the first frame of the contact, counted from 0 in the order taken
  std::int64_t frames = 0;     ///< how many frames in a row, >= 1
  double begin = 0, last = 0;  ///< times of the first and the last of them [time]
  bool begun_before = false;   ///< there in the first frame taken, so it may have begun before
  bool not_ended = false;      ///< there in the last frame taken, so it may go on

  /// Time in which every frame shows the contact [time]; 0 for a contact seen in one frame. Frames do not say
  /// when between them it began and ended.
  double duration() const { return last - begin; }
};

/// Follows contacts from frame to frame. It holds those of one frame; what has ended is handed out, so memory
/// does not grow with the length of a trajectory.
class ContactEvents {
 public:
  /// Takes the contacts of the next frame.
  /// @param time of the frame, not below that of the frame before
  /// @param contacts in ascending order of (i, j), as find_contacts() gives them
  /// @returns the contacts that were there in the frame before and are not any more, in ascending order of
  ///   (i, j); valid until the next call. O(contacts of both frames).
  /// @throws InvalidParameter, taking nothing, for a time that is not finite or goes back, and for contacts
  ///   that are out of order or given twice.
  Span<const ContactEvent> add(double time, Span<const Contact> contacts);

  /// The contacts of the last frame, as not ended, in ascending order of (i, j). The object is as new then.
  std::vector<ContactEvent> finish();

  std::int64_t frames() const { return frames_; }          ///< taken so far
  std::size_t running() const { return running_.size(); }  ///< contacts in the last frame

 private:
  std::vector<ContactEvent> running_, next_, ended_;
  std::int64_t frames_ = 0;
  double time_ = 0;
};

}  // namespace dch::necklace
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/kinetic/contacts_between.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/trajectory/frame.hpp>

#include "engines/verifier.hpp"
#include "report/between_report.hpp"

namespace dch::cli {

/// Follows the atoms from each frame to the next one, and finds the contacts in between.
class BetweenFrames {
 public:
  /// @param cutoff [length]
  /// @param engine that finds pairs, as make_search() names it
  /// @param threads to search with; null for one. Not owned.
  BetweenFrames(double cutoff, const std::string& engine, Executor* threads)
      : cutoff_(cutoff), contacts_between_(cutoff, engine, threads) {}

  /// Follows the atoms that both frames hold from the frame before to this one.
  /// @param index of the frame in the file
  /// @param exclusions of the frame's atoms
  /// @return false for the first frame, which has none before it
  /// @throws InvalidPosition, InvalidBox and other errors of ContactsBetween::find.
  bool follow(const trajectory::Frame& frame, std::int64_t index, const Exclusions& exclusions);

  /// The interval that was followed last, and its contacts by atoms.
  const IntervalRecord& record() const { return record_; }
  const std::vector<BetweenContact>& contacts() const { return contacts_; }
  /// What a verifier needs of it, good until the next call.
  Verifier::Interval subject() const;

 private:
  void match(const trajectory::Frame& frame);
  void find(const Exclusions& exclusions);

  double cutoff_;
  kinetic::ContactsBetween contacts_between_;
  trajectory::Frame last_;            ///< the frame before
  std::int64_t last_index_ = -1;      ///< none yet: -1
  std::vector<std::int64_t> ids_;     ///< of the atoms in both frames
  std::vector<Vec3> before_, after_;  ///< where they are
  Box box_before_, box_after_;
  IntervalRecord record_;
  std::vector<BetweenContact> contacts_;
  std::vector<std::int32_t> undetermined_;
  std::vector<std::int32_t> places_;  ///< of the atoms in both frames, in the later one
  const Exclusions* exclusions_ = nullptr;
};

}  // namespace dch::cli

// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/base/span.hpp>
#include <dch/base/vec3.hpp>
#include <dch/geometry/box.hpp>

#pragma GCC visibility push(default)
namespace dch::kinetic {

/// A pair of points that is within the cutoff for a while between two frames: from one moment to the next one
/// at which it is not. Moments are fractions of the time between the frames.
struct PassingContact {
  std::int32_t i = -1, j = -1;                           ///< i < j
  double enters = 0;                                     ///< 0 where the earlier frame shows the contact
  double leaves = 1;                                     ///< 1 where the later frame shows it
  double closest = 0;                                    ///< least distance in that time [length]
  bool is_shown_before = false, is_shown_after = false;  ///< by the earlier frame, by the later one

  /// Neither frame shows it.
  bool is_hidden() const { return !is_shown_before && !is_shown_after; }
};

/// What happens between two frames.
struct PassingContacts {
  /// Why nothing can be said of the whole interval, in words; empty if something can.
  std::string undetermined;
  /// Points whose motion is not known, ascending: their displacement reaches half the smallest height of the
  /// box, so that another image is as likely the one that they have gone to. Contacts are those of all
  /// others.
  std::vector<std::int32_t> undetermined_points;
  /// Contacts that come, go or do both between the frames, by i, j and time. Those that last from the one
  /// frame to the other are left out.
  std::vector<PassingContact> contacts;
  std::int64_t candidates = 0;  ///< pairs that were looked at
};

/// Boxes that change more than this between two frames (the norm of the strain) leave images undetermined.
inline constexpr double kMaxStrain = 0.1;

/// The contacts that come and go between two frames of a trajectory, and those that no frame shows: pairs
/// within a cutoff of each other while all points move in straight lines at constant speed.
///
/// Each point moves from its place in the earlier frame to the image in the later one that is nearest, and so
/// do all its images. Where the box changes, its vectors move in straight lines too, each to the vector of
/// the later lattice that is nearest (so a flip of a tilted cell is none), and the image of a point is the
/// one that is nearest to where the change of the box alone would put it. Distances are those of nearest
/// images; at the frames they are compared with the cutoff as ListParams defines it, to the last bit. In
/// between, a pair that touches the cutoff and turns has no contact, and rounding decides for pairs that come
/// as near to the cutoff as that (1e-14 of the coordinates).
///
/// With linear motion the distance of a pair has one minimum, in closed form. Pairs that come near enough for
/// it are found by one list at the middle of the interval, where each point stands for its way: its radius is
/// half the cutoff and half its displacement. So one interval costs about one list with that radius, and no
/// events are queued: make_kinetic_edges() finds the same contacts, for plans that go on or change. Points
/// whose way is too long for the box's images in a list are compared with all others: O(n) each.
///
/// The search structure is kept from interval to interval; contacts depend neither on it nor on threads. Not
/// thread-safe. After a throw the next find() starts anew.
class ContactsBetween {
 public:
  /// @param cutoff > 0 [length]
  /// @param engine that finds the candidates, as make_search() names it
  /// @param executor threads to search with; null for that of the caller alone. Not owned.
  /// @throws InvalidParameter for a cutoff out of range or another name.
  explicit ContactsBetween(double cutoff, std::string engine = "auto", Executor* executor = nullptr);
  ~ContactsBetween();
  ContactsBetween(ContactsBetween&&) noexcept;
  ContactsBetween& operator=(ContactsBetween&&) noexcept;

  /// The contacts between two frames of the same points, valid until the next call.
  /// @throws InvalidParameter if there are not as many positions in both frames; InvalidPosition;
  ///   CutoffTooLarge if the cutoff exceeds max_cutoff() of either box.
  const PassingContacts& find(Span<const Vec3> before, const Box& box_before, Span<const Vec3> after,
                              const Box& box_after);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A contact as the oracle sees it.
struct OracleContact : PassingContact {
  /// How far the distances that decide are from the cutoff: where it is below the rounding of coordinates,
  /// the contact may not be there, or be shown by a frame [length].
  double margin = 0;
};

/// The oracle: the hidden contacts between two frames by looking at all pairs and images in long double, with
/// the least distance on a segment in closed form. It shares no code with ContactsBetween. Contacts that
/// would be hidden if the cutoff were `slack` larger, or if frames showed pairs up to `slack` less than the
/// cutoff, are told too: their margin is at most 0. The box's change has to be one that ContactsBetween
/// determines. O(n^2), or O(n) for each of some points.
/// @param points whose contacts are looked for: all, if none are given
/// @param undetermined points whose contacts are left out, ascending
std::vector<OracleContact> all_hidden_contacts(double cutoff, double slack, Span<const Vec3> before,
                                               const Box& box_before, Span<const Vec3> after,
                                               const Box& box_after,
                                               Span<const std::int32_t> undetermined = {},
                                               Span<const std::int32_t> points = {});

}  // namespace dch::kinetic
#pragma GCC visibility pop

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

namespace dch::necklace {

/// What contacts are searched with.
enum class Structure {
  wrapped,  ///< the wrapped hierarchy: cheap while chains are stretched
  dch       ///< near pairs from a discrete center hierarchy, filtered: the same cost however packed they are
};

/// A choice, and why it was made.
struct StructureChoice {
  Structure structure = Structure::wrapped;
  /// Cage pairs that the last whole search of the wrapped hierarchy compared, for each bead; below 0 if there
  /// was none yet.
  double visited_per_bead = -1;
  std::string reason = "no search yet: the wrapped hierarchy is measured first";
};

struct ContactFinderParams {
  WrappedParams wrapped;
  /// The DCH takes over above this many visited pairs a bead, >= 0. Defaults are from measurements
  /// (docs/necklaces.md).
  double to_dch = 1.2;
  /// The wrapped hierarchy comes back below this many, 0 .. to_dch.
  double to_wrapped = 0.8;
  /// While the DCH has its turn, one search in so many is the wrapped hierarchy's, to measure, >= 1.
  int measure_every = 50;
  /// Threads to search on, whichever structure does; null for that of the caller alone. Not owned; contacts
  /// do not depend on it.
  Executor* executor = nullptr;
};

/// Contacts by the structure that suits the scene: a figure for how packed the chains are, visited pairs for
/// each bead, decides between the wrapped hierarchy and the DCH. Both give the same contacts. What the DCH
/// does not take (beads and gaps that reach less than kMinListRadius or more than kMaxListRadius, positions
/// that rounding makes uncertain in a periodic box) the wrapped hierarchy answers in its turn too, and what
/// the wrapped hierarchy does not take (bonds that leave images undetermined, as unwrap() says) the DCH does:
/// contacts go by the positions as given, whatever the bonds. So the outcome does not depend on whose turn it
/// is.
///
/// A search that ends at its first contact does not measure, as it costs little. Periodic boxes as for
/// either structure. Not thread-safe; distinct objects are independent.
class ContactFinder {
 public:
  /// @throws InvalidParameter for a parameter out of its range.
  explicit ContactFinder(Necklace necklace, const ContactFinderParams& params = {});

  /// Takes new positions, after any displacement; structures follow when they are asked.
  /// @throws InvalidParameter for another number of positions than particles, InvalidPosition. Nothing is
  ///   held after a throw until the next successful update.
  void update(Span<const Vec3> positions, const Box& box);

  /// As the functions of these names in contacts.hpp, which say what a contact is and in which order they
  /// come.
  /// @throws as these do, and Undetermined where neither structure takes the positions.
  bool any_contact(const ContactQuery& query);
  std::vector<Contact> find_contacts(const ContactQuery& query);

  /// What the next search takes, unless it is its turn to measure.
  const StructureChoice& choice() const { return choice_; }
  const Necklace& necklace() const { return wrapped_.necklace(); }

 private:
  bool measures_now();
  const WrappedHierarchy& wrapped_now();
  bool wrapped_takes();
  void measured(const ContactStats& stats);
  bool list_near(const ContactQuery& query);
  bool is_contact(std::int32_t p, std::int32_t q, const ContactQuery& query) const;
  /// @param p the place of the particle of lower index
  Contact contact_at(std::int32_t p, std::int32_t q) const;
  bool by_dch(const ContactQuery& query, bool first_only, std::vector<Contact>& out);

  ContactFinderParams params_;
  WrappedHierarchy wrapped_;
  std::unique_ptr<PairSearch> search_;
  double search_radius_ = 0;
  NeighborList list_;
  std::vector<double> radii_;  ///< by place
  std::vector<Vec3> given_;    ///< positions by particle
  std::vector<Vec3> by_place_;
  Box box_;
  bool ready_ = false, wrapped_is_new_ = false, search_is_new_ = false;
  int since_measured_ = 0;
  StructureChoice choice_;
};

}  // namespace dch::necklace

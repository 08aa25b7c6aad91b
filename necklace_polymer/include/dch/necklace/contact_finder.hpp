// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <dch/base/executor.hpp>
#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>
#include <dch/necklace/contacts.hpp>
#include <dch/necklace/wrapped_hierarchy.hpp>

#pragma GCC visibility push(default)
namespace dch::necklace {

/// What contacts are searched with.
enum class Structure {
  wrapped,  ///< the wrapped hierarchy: cheap while chains are stretched
  dch       ///< near pairs from a discrete center hierarchy, filtered: the same cost however packed they are
};

/// "wrapped" or "dch".
std::string name_of(Structure structure);

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
  double to_dch = 1.8;
  /// The wrapped hierarchy comes back below this many, 0 .. to_dch.
  double to_wrapped = 1.4;
  /// While the DCH has its turn, one search in so many is the wrapped hierarchy's, to measure, >= 1.
  int measure_every = 50;
  /// Refuse bonds that leave images undetermined, whichever structure answers: for hosts to which such a bond
  /// means chains that do not fit the positions.
  bool refuse_undetermined = false;
  /// Threads to search on, whichever structure does; null for that of the caller alone. Not owned; contacts
  /// do not depend on it.
  Executor* executor = nullptr;
};

/// Contacts by the structure that suits the scene: a figure for how packed the chains are, visited pairs for
/// each bead, decides between the wrapped hierarchy and the DCH. The figure is a count, the same on any
/// number of threads, and so are the choice and the contacts. Both structures give the same contacts, bit for
/// bit.
///
/// Whose turn it is changes no outcome, since either answers what the other does not take:
///  - the wrapped hierarchy takes points (beads and gaps that reach less than kMinListRadius), reaches above
///    kMaxListRadius, and positions that rounding makes uncertain in a periodic box;
///  - the DCH takes bonds that leave images undetermined (unwrap()), unless these are to be refused: contacts
///    go by the positions as given, whatever the bonds.
///
/// The first search measures, so it is the wrapped hierarchy's. A search that ends at its first contact does
/// not measure, as it costs little. Periodic boxes as for either structure. Not thread-safe; distinct objects
/// are independent.
class ContactFinder {
 public:
  /// @throws InvalidParameter for a parameter out of its range.
  explicit ContactFinder(Necklace necklace, const ContactFinderParams& params = {});

  /// Takes new positions, after any displacement; structures follow when they are asked. O(n).
  /// @throws InvalidParameter for another number of positions than particles, InvalidPosition. Nothing is
  ///   held after a throw until the next successful update.
  void update(Span<const Vec3> positions, const Box& box);

  /// Goes on with other chains, as a part of a scene does whose beads come and go: a new finder to which the
  /// choice is left, so that it need not measure first. Positions are to be given anew. O(n), n beads.
  /// @param names by particle, all different: the DCH is kept, and repaired by the particles that have the
  ///   names they had, if there were names before; made anew without.
  /// @throws InvalidParameter for another number of names than particles. After a throw the chains are those
  ///   before.
  void replace(Necklace necklace, Span<const std::uint64_t> names = {});

  /// Brings the structure that the next search takes up to date, which that search would do itself: for
  /// callers who time the two apart.
  /// @throws as the search.
  void prepare(const ContactQuery& query) { request_of_turn(query); }

  /// As the functions of these names in contacts.hpp, which say what a contact is and in which order they
  /// come.
  /// @throws as these do, and Undetermined where neither structure takes the positions, or where bonds are to
  ///   be refused.
  bool any_contact(const ContactQuery& query);
  std::vector<Contact> find_contacts(const ContactQuery& query);

  /// What the next search takes, unless it is its turn to measure.
  const StructureChoice& choice() const { return choice_; }
  /// What the last search was answered by; the wrapped hierarchy before the first one.
  Structure answered_by() const { return answered_by_; }
  const Necklace& necklace() const { return wrapped_.necklace(); }
  /// As it was when it last had its turn.
  const WrappedHierarchy& wrapped() const { return wrapped_; }
  /// Of both structures and what is kept beside them. O(1).
  std::size_t memory_bytes() const;

 private:
  bool is_turn_of_wrapped() const;
  const WrappedHierarchy& wrapped_now();
  bool wrapped_takes();
  std::optional<ListParams> request_of_turn(const ContactQuery& query);
  std::optional<ListParams> near_pairs(const ContactQuery& query) const;
  bool dch_takes(const ListParams& request);
  void place_beads();
  void require_determined() const;
  void measured(const ContactStats& stats);
  /// @param p the place of the particle of lower index
  Contact contact_at(std::int32_t p, std::int32_t q) const;
  bool by_dch(const ListParams& request, const ContactQuery& query, bool first_only,
              std::vector<Contact>& out);

  ContactFinderParams params_;
  WrappedHierarchy wrapped_;
  std::unique_ptr<PairSearch> search_;
  double search_radius_ = 0;
  bool search_is_sized_ = false;
  NeighborList list_;
  std::vector<double> radii_;         ///< by place
  std::vector<std::uint64_t> names_;  ///< by place; none for the places themselves
  double smallest_radius_ = 0;
  std::vector<Vec3> given_;     ///< positions by particle
  std::vector<Vec3> by_place_;  ///< as the DCH has them
  Box box_;
  bool ready_ = false, wrapped_is_new_ = false, search_is_new_ = false;
  int since_measured_ = 0;
  Structure answered_by_ = Structure::wrapped;
  StructureChoice choice_;
};

}  // namespace dch::necklace
#pragma GCC visibility pop

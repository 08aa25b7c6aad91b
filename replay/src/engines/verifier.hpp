// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <dch/engines/pair_search.hpp>
#include <dch/geometry/box.hpp>
#include <dch/kinetic/contacts_between.hpp>
#include <dch/lists/exclusions.hpp>
#include <dch/lists/list_params.hpp>
#include <dch/lists/neighbor_list.hpp>
#include <dch/trajectory/frame.hpp>

#include "engines/between_contact.hpp"

namespace dch::cli {

enum class VerifyMode { none, sample, all };
std::string to_string(VerifyMode mode);

/// What differs from the oracle.
struct Mismatch {
  std::int64_t frame = 0;        ///< index in the file, from 0
  std::int64_t next_frame = -1;  ///< of what is between two frames, else -1
  /// "missing", "extra", "order", "structure"; "hidden missing", "hidden extra" of contacts that no frame
  /// shows
  std::string what;
  std::int64_t atom_a = 0, atom_b = 0;  ///< ids of the file; 0 where there is no pair
  double distance = 0;                  ///< of the pair [length]
  std::string detail;                   ///< for "structure": the invariant that fails

  std::string message(const std::string& unit) const;
};

/// The result of all checks of a run.
struct VerifyResult {
  VerifyMode mode = VerifyMode::none;
  std::uint64_t seed = 0;               ///< of the sampled atoms
  std::vector<std::int64_t> frames;     ///< indices of the frames checked
  std::vector<std::int64_t> intervals;  ///< earlier frames of the intervals checked
  std::int64_t rows = 0;                ///< atoms whose neighbors were compared, summed over the frames
  std::int64_t structure_checks = 0;    ///< frames whose hierarchy was checked by PairSearch::validate()
  std::int64_t mismatches = 0;  ///< rows' entries missing or extra, rows out of order, broken structures
  std::vector<Mismatch> first;  ///< the first kMaxReported of them
};

/// Compares lists with the all-pairs oracle.
///
/// A list built at the frame in question must equal the oracle's at cutoff + skin exactly, order included:
/// the library defines pairs at the cutoff to the last bit. A list kept from an earlier frame must hold every
/// pair within the cutoff alone; what it holds beyond is the skin's.
class Verifier {
 public:
  static constexpr std::size_t kMaxReported = 20;
  static constexpr std::int64_t kSampledFrames = 10;
  static constexpr std::size_t kSampledAtoms = 1000;
  static constexpr std::uint64_t kSeed = 20060517;
  /// PairSearch::validate() takes n^2 steps a level; larger hierarchies are checked through their lists
  /// alone.
  static constexpr std::size_t kMaxValidatedAtoms = 5000;

  /// @param params of the list under test; outlives the verifier
  /// @param frames number of frames that check() will see
  Verifier(VerifyMode mode, const ListParams& params, std::int64_t frames);

  /// The list and the structure of one frame.
  struct Subject {
    std::int64_t ordinal = 0;  ///< number of the frame among those replayed, from 0
    std::int64_t index = 0;    ///< number of the frame in the file
    const trajectory::Frame* frame = nullptr;
    const NeighborList* list = nullptr;
    bool list_is_new = true;          ///< built from this very frame
    PairSearch* structure = nullptr;  ///< the engine, if it keeps a hierarchy
  };
  void check(const Subject& subject);

  /// The contacts that no frame shows of one interval between two frames; atoms are those of both.
  struct Interval {
    std::int64_t ordinal = 0;  ///< number of the interval among those replayed, from 0
    std::int64_t frame = 0, next_frame = 0;
    double cutoff = 0;  ///< [length]
    Span<const std::int64_t> ids;
    Span<const Vec3> before, after;
    const Box *box_before = nullptr, *box_after = nullptr;
    Span<const std::int32_t> undetermined;  ///< atoms that were left out
    Span<const BetweenContact> contacts;    ///< found, by i and j
    const Exclusions* exclusions = nullptr;
    Span<const std::int32_t> places;  ///< of the atoms, by which exclusions go
  };
  /// Compares them with kinetic::all_hidden_contacts(), as exactly as coordinates are rounded.
  void check_between(const Interval& interval);

  const VerifyResult& result() const { return result_; }

 private:
  void check_all(const Subject& subject, const ListParams& params);
  void check_sample(const Subject& subject, const ListParams& params);
  void check_structure(const Subject& subject);
  void compare_row(const Subject& subject, std::int32_t i, Span<const std::int32_t> found,
                   Span<const std::int32_t> expected);
  void compare_pair(const Interval& interval, Span<const BetweenContact> found,
                    Span<const kinetic::OracleContact> expected, double slack);
  void report_pair(const Subject& subject, const char* what, std::int32_t i, std::int32_t j);
  void report(Mismatch mismatch);
  std::vector<std::int32_t> sample_atoms(std::size_t n);

  const ListParams& params_;
  std::set<std::int64_t> sampled_;  ///< ordinals of the frames to check in sample mode
  std::set<std::int64_t> sampled_intervals_;
  std::mt19937_64 random_{kSeed};
  VerifyResult result_;
};

/// Ordinals of at most `wanted` frames spread evenly over `frames`, the first and the last among them.
std::set<std::int64_t> spread_evenly(std::int64_t frames, std::int64_t wanted);

}  // namespace dch::cli

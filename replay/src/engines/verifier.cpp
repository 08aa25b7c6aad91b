// SPDX-License-Identifier: MIT
#include "engines/verifier.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numeric>
#include <utility>

#include <dch/lists/all_pairs.hpp>

namespace dch::cli {
namespace {

/// Rows of both directions for some atoms, gathered from a half or full list.
std::vector<std::vector<std::int32_t>> full_rows(const NeighborList& list,
                                                 const std::vector<std::int32_t>& atoms) {
  std::vector<std::int32_t> slot(list.size(), -1);
  for (std::size_t k = 0; k < atoms.size(); ++k)
    slot[static_cast<std::size_t>(atoms[k])] = static_cast<std::int32_t>(k);
  std::vector<std::vector<std::int32_t>> rows(atoms.size());
  const bool mirror = list.kind == ListKind::half;
  for (std::size_t i = 0; i < list.size();
       ++i) {  // rows ascend, so mirrored entries arrive in order, before the own row
    for (const std::int32_t j : list.row(i)) {
      if (slot[i] >= 0) rows[static_cast<std::size_t>(slot[i])].push_back(j);
      const std::int32_t other = slot[static_cast<std::size_t>(j)];
      if (mirror && other >= 0) rows[static_cast<std::size_t>(other)].push_back(static_cast<std::int32_t>(i));
    }
  }
  return rows;
}

std::vector<std::int32_t> sorted_copy(Span<const std::int32_t> row) {
  std::vector<std::int32_t> copy(row.begin(), row.end());
  std::sort(copy.begin(), copy.end());
  return copy;
}

}  // namespace

std::string to_string(VerifyMode mode) {
  switch (mode) {
    case VerifyMode::sample:
      return "sample";
    case VerifyMode::all:
      return "all";
    case VerifyMode::none:
      break;
  }
  return "none";
}

std::string Mismatch::message(const std::string& unit) const {
  if (what == "structure") return fmt::format("frame {}: the hierarchy is broken: {}", frame, detail);
  if (what == "order")
    return fmt::format("frame {}: the neighbors of atom {} are not in ascending order", frame, atom_a);
  if (next_frame >= 0) {
    return fmt::format(
        "frames {} to {}: a contact of atoms {} and {} that no frame shows, as close as {} ({}), {}", frame,
        next_frame, atom_a, atom_b, distance, unit,
        what == "hidden missing" ? "is missing" : "is told of, but is none");
  }
  return fmt::format(
      "frame {}: pair of atoms {} and {} at distance {} ({}) is {}", frame, atom_a, atom_b, distance, unit,
      what == "missing" ? "missing from the list" : "in the list but beyond its radius or excluded");
}

std::set<std::int64_t> spread_evenly(std::int64_t frames, std::int64_t wanted) {
  std::set<std::int64_t> chosen;
  const std::int64_t count = std::min(frames, wanted);
  for (std::int64_t k = 0; k < count; ++k) chosen.insert(count == 1 ? 0 : k * (frames - 1) / (count - 1));
  return chosen;
}

Verifier::Verifier(VerifyMode mode, const ListParams& params, std::int64_t frames) : params_(params) {
  result_.mode = mode;
  result_.seed = kSeed;
  if (mode != VerifyMode::sample) return;
  sampled_ = spread_evenly(frames, kSampledFrames);
  sampled_intervals_ = spread_evenly(frames - 1, kSampledFrames);
}

void Verifier::check(const Subject& subject) {
  if (result_.mode == VerifyMode::none) return;
  if (result_.mode == VerifyMode::sample && !sampled_.contains(subject.ordinal)) return;
  result_.frames.push_back(subject.index);
  ListParams params = params_;
  if (!subject.list_is_new) params.skin = 0;
  if (result_.mode == VerifyMode::sample) {
    check_sample(subject, params);
  } else {
    check_all(subject, params);
    check_structure(subject);
  }
}

void Verifier::check_all(const Subject& subject, const ListParams& params) {
  const NeighborList expected = all_pairs(subject.frame->positions, subject.frame->box, params);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    compare_row(subject, static_cast<std::int32_t>(i), subject.list->row(i), expected.row(i));
  }
}

void Verifier::check_sample(const Subject& subject, const ListParams& params) {
  const std::vector<std::int32_t> atoms = sample_atoms(subject.frame->positions.size());
  const auto rows = full_rows(*subject.list, atoms);
  for (std::size_t k = 0; k < atoms.size(); ++k) {
    const auto expected = all_neighbors(atoms[k], subject.frame->positions, subject.frame->box, params);
    compare_row(subject, atoms[k], rows[k], expected);
  }
}

void Verifier::check_structure(const Subject& subject) {
  const bool is_current = subject.list_is_new;  // a kept list leaves the hierarchy at the earlier frame too
  if (!subject.structure || !is_current || subject.frame->positions.size() > kMaxValidatedAtoms) return;
  ++result_.structure_checks;
  std::string violation = subject.structure->validate();
  if (violation.empty()) return;
  Mismatch mismatch;
  mismatch.frame = subject.index;
  mismatch.what = "structure";
  mismatch.detail = std::move(violation);
  report(std::move(mismatch));
}

void Verifier::compare_row(const Subject& subject, std::int32_t i, Span<const std::int32_t> found,
                           Span<const std::int32_t> expected) {
  ++result_.rows;
  if (std::equal(found.begin(), found.end(), expected.begin(), expected.end())) return;
  const std::vector<std::int32_t> row = sorted_copy(found);
  if (!std::equal(found.begin(), found.end(), row.begin())) {
    Mismatch mismatch;
    mismatch.frame = subject.index;
    mismatch.what = "order";
    mismatch.atom_a = subject.frame->ids[static_cast<std::size_t>(i)];
    report(std::move(mismatch));
  }
  std::vector<std::int32_t> difference;
  std::set_difference(expected.begin(), expected.end(), row.begin(), row.end(),
                      std::back_inserter(difference));
  for (const std::int32_t j : difference) report_pair(subject, "missing", i, j);
  if (!subject.list_is_new) return;
  difference.clear();
  std::set_difference(row.begin(), row.end(), expected.begin(), expected.end(),
                      std::back_inserter(difference));
  for (const std::int32_t j : difference) report_pair(subject, "extra", i, j);
}

void Verifier::report_pair(const Subject& subject, const char* what, std::int32_t i, std::int32_t j) {
  const trajectory::Frame& frame = *subject.frame;
  const auto a = static_cast<std::size_t>(i);
  const auto b = static_cast<std::size_t>(j);
  Mismatch mismatch;
  mismatch.frame = subject.index;
  mismatch.what = what;
  mismatch.atom_a = frame.ids[a];
  mismatch.atom_b = frame.ids[b];
  mismatch.distance = std::sqrt(frame.box.distance2(frame.positions[a], frame.positions[b]));
  report(std::move(mismatch));
}

void Verifier::report(Mismatch mismatch) {
  ++result_.mismatches;
  if (result_.first.size() < kMaxReported) result_.first.push_back(std::move(mismatch));
}

std::vector<std::int32_t> Verifier::sample_atoms(std::size_t n) {
  std::vector<std::int32_t> atoms(n);
  std::iota(atoms.begin(), atoms.end(), 0);
  if (n <= kSampledAtoms) return atoms;
  for (std::size_t k = 0; k < kSampledAtoms;
       ++k) {  // the modulus is the same on every platform; its bias is below 1e-9
    std::swap(atoms[k], atoms[k + static_cast<std::size_t>(random_() % (n - k))]);
  }
  atoms.resize(kSampledAtoms);
  return atoms;
}

}  // namespace dch::cli

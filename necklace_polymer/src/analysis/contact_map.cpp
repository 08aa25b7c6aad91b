// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string>

#include <dch/necklace/contact_map.hpp>

#include "analysis/bead_places.hpp"
#include "chains/parameter_check.hpp"

namespace dch::necklace {

namespace {

std::int32_t beads_of(const Necklace& necklace, std::size_t chain) {
  return necklace.first_place(chain + 1) - necklace.first_place(chain);
}

/// n items in parts of at most `part`.
std::int64_t parts_of(std::int64_t n, std::int64_t part) { return (n + part - 1) / part; }

/// The smallest number of beads a bin with which all chains take at most max_bins bins.
std::int32_t least_bin_size(const Necklace& necklace, std::int32_t max_bins) {
  const auto bins_of_size = [&](std::int64_t size) {
    std::int64_t bins = 0;
    for (std::size_t chain = 0; chain < necklace.chains().size(); ++chain) {
      bins += parts_of(beads_of(necklace, chain), size);
    }
    return bins;
  };
  std::int32_t low = 1, high = static_cast<std::int32_t>(std::max<std::size_t>(1, necklace.size()));
  while (low < high) {
    const std::int32_t middle = low + (high - low) / 2;
    if (bins_of_size(middle) <= max_bins) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

/// Pairs (u, v) of whole numbers >= 0 with u + v <= t.
std::int64_t corner(std::int64_t t) { return t < 0 ? 0 : (t + 1) * (t + 2) / 2; }

/// Pairs of p in [a, a + m) and q in [b, b + n) with q - p <= x; b >= a + m. With u = a + m - 1 - p and
/// v = q - b it says u + v <= t, where u < m and v < n.
std::int64_t pairs_at_most(std::int64_t a, std::int64_t m, std::int64_t b, std::int64_t n, std::int64_t x) {
  const std::int64_t t = x - (b - a - m + 1);
  return corner(t) - corner(t - m) - corner(t - n) + corner(t - m - n);
}

/// Pairs p < q of m places in a row with q - p <= x.
std::int64_t own_pairs_at_most(std::int64_t m, std::int64_t x) {
  const std::int64_t d = std::clamp<std::int64_t>(x, 0, std::max<std::int64_t>(0, m - 1));
  return m * d - d * (d + 1) / 2;
}

/// Of the pairs whose number with q - p <= x the function tells, those in a chain of `size` beads with more
/// than `skip` bonds between them.
template <class AtMost>
std::int64_t pairs_beyond(std::int64_t size, bool closed, std::int64_t skip, AtMost at_most) {
  skip = std::min(skip, size - 1);
  if (closed && 2 * skip >= size) return 0;
  return at_most(closed ? size - skip - 1 : size - 1) - at_most(skip);
}

}  // namespace

ContactMap::ContactMap(const Necklace& necklace, const ContactQuery& query, std::int32_t max_bins)
    : query_(query),
      place_(detail::places_by_particle(necklace)),
      places_(static_cast<std::int32_t>(necklace.size())) {
  detail::require_parameter(max_bins >= 1 && max_bins <= kMaxBins,
                            "the number of bins is " + std::to_string(max_bins) + "; it has to be 1 to " +
                                std::to_string(kMaxBins));
  detail::require_parameter(query.skip_bonds >= 0,
                            "skip_bonds is " + std::to_string(query.skip_bonds) + "; it has to be 0 or more");
  if (necklace.chains().size() <= static_cast<std::size_t>(max_bins)) {
    cut_chains(necklace, max_bins);
  } else {
    gather_chains(necklace, max_bins);
  }
  bin_.resize(necklace.size());
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    std::fill(bin_.begin() + bins_[k].first, bin_.begin() + bins_[k].last, static_cast<std::int32_t>(k));
  }
  count_.resize(bins_.size() * (bins_.size() + 1) / 2);
}

void ContactMap::cut_chains(const Necklace& necklace, std::int32_t max_bins) {
  const std::int32_t largest = least_bin_size(necklace, max_bins);
  for (std::size_t chain = 0; chain < necklace.chains().size(); ++chain) {
    const std::int32_t start = necklace.first_place(chain), size = beads_of(necklace, chain);
    const std::int64_t parts = parts_of(size, largest);
    for (std::int64_t part = 0; part < parts; ++part) {
      Bin bin;
      bin.first = start + static_cast<std::int32_t>(part * size / parts);
      bin.last = start + static_cast<std::int32_t>((part + 1) * size / parts);
      bin.chain = start;
      bin.size = size;
      bin.closed = necklace.chains().closed(chain);
      if (query_.within_chains) {
        const std::int64_t beads = bin.last - bin.first;
        bin.own_pairs = pairs_beyond(size, bin.closed, query_.skip_bonds,
                                     [&](std::int64_t x) { return own_pairs_at_most(beads, x); });
      }
      bins_.push_back(bin);
    }
  }
}

void ContactMap::gather_chains(const Necklace& necklace, std::int32_t max_bins) {
  const std::size_t chains = necklace.chains().size();
  const auto in_bin = static_cast<std::size_t>(parts_of(static_cast<std::int64_t>(chains), max_bins));
  for (std::size_t begin = 0; begin < chains; begin += in_bin) {
    const std::size_t end = std::min(begin + in_bin, chains);
    Bin bin;
    bin.first = necklace.first_place(begin);
    bin.last = necklace.first_place(end);
    bin.chain = -1;
    for (std::size_t chain = begin; chain < end; ++chain) {
      const std::int64_t size = beads_of(necklace, chain);
      const auto at_most = [&](std::int64_t x) { return own_pairs_at_most(size, x); };
      if (query_.within_chains) {
        bin.own_pairs += pairs_beyond(size, necklace.chains().closed(chain), query_.skip_bonds, at_most);
      }
      if (query_.between_chains) bin.own_pairs += size * (bin.last - necklace.first_place(chain + 1));
    }
    bins_.push_back(bin);
  }
}

void ContactMap::add(Span<const Contact> contacts) {
  for (const Contact& contact : contacts) {
    const auto [p, q] = detail::places_of(contact, place_);
    const std::int32_t a = bin_[static_cast<std::size_t>(p)], b = bin_[static_cast<std::size_t>(q)];
    ++count_[entry(static_cast<std::size_t>(a), static_cast<std::size_t>(b))];
  }
  ++frames_;
}

std::int64_t ContactMap::pairs(std::size_t a, std::size_t b) const {
  if (a == b) return bins_[a].own_pairs;
  const Bin& low = bins_[std::min(a, b)];
  const Bin& high = bins_[std::max(a, b)];
  const std::int64_t m = low.last - low.first, n = high.last - high.first;
  if (low.chain < 0 || low.chain != high.chain) return query_.between_chains ? m * n : 0;
  if (!query_.within_chains) return 0;
  return pairs_beyond(low.size, low.closed, query_.skip_bonds,
                      [&](std::int64_t x) { return pairs_at_most(low.first, m, high.first, n, x); });
}

double ContactMap::frequency(std::size_t a, std::size_t b) const {
  const std::int64_t possible = pairs(a, b);
  if (possible == 0 || frames_ == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(contacts(a, b)) / (static_cast<double>(possible) * static_cast<double>(frames_));
}

}  // namespace dch::necklace

// SPDX-License-Identifier: GPL-2.0-or-later
#include "bond_check.h"

#include <algorithm>
#include <array>
#include <comm.h>
#include <map>

namespace LAMMPS_NS {
namespace {

using dch::Vec3;

/// What travels: a number that tells what it is, x, y, z. A bond has the number of the place it begins at;
/// its ends are 2 bond and 2 bond + 1, the sum of a ring's bonds is -1 - chain.
constexpr std::size_t kNumbers = 4;

class Bonds {
 public:
  explicit Bonds(const dch::Box& box)
      : box_(box), limit2_((1 - 1e-9) * box.max_cutoff() * box.max_cutoff()), periodic_(box.any_periodic()) {}

  void add(std::size_t chain, bool closed, Vec3 from, Vec3 to) {
    const Vec3 bond = box_.nearest_image(to - from);
    look_at(bond);
    if (closed) add_around(chain, bond);
  }
  void add_around(std::size_t ring, Vec3 bonds) { around_[ring] = around_[ring] + bonds; }
  /// By ring.
  const std::map<std::size_t, Vec3>& around() const { return around_; }
  void look_at(Vec3 d) { sound_ = sound_ && (!periodic_ || norm2(d) < limit2_); }
  bool sound() const { return sound_; }

 private:
  const dch::Box& box_;
  double limit2_;
  bool periodic_, sound_ = true;
  std::map<std::size_t, Vec3> around_;
};

/// The own beads by place.
class OwnPlaces {
 public:
  OwnPlaces(const ChainMap& map, const NearBeads& beads) : beads_(beads) {
    for (std::size_t k = 0; k < beads.size(); ++k)
      if (beads.is_own(k)) own_.push_back({map.place_of(beads.beads()[k]), static_cast<std::int32_t>(k)});
    std::sort(own_.begin(), own_.end());
  }
  /// Null where the bead at this place is another process's.
  const Vec3* at(std::int32_t place) const {
    const auto found = std::lower_bound(own_.begin(), own_.end(), Entry{place, 0});
    if (found == own_.end() || (*found)[0] != place) return nullptr;
    return &beads_.positions()[static_cast<std::size_t>((*found)[1])];
  }
  template <class Use>
  void for_each(const Use& use) const {
    for (const Entry& entry : own_) use(entry[0], beads_.positions()[static_cast<std::size_t>(entry[1])]);
  }

 private:
  using Entry = std::array<std::int32_t, 2>;  // place and index
  const NearBeads& beads_;
  std::vector<Entry> own_;
};

/// What other processes sent: ends of bonds, which meet here, and sums of rings.
void add_received(const std::vector<double>& numbers, const dch::necklace::Necklace& chains, Bonds& bonds) {
  std::map<double, Vec3> ends;
  for (std::size_t k = 0; k + kNumbers <= numbers.size(); k += kNumbers) {
    const Vec3 v{numbers[k + 1], numbers[k + 2], numbers[k + 3]};
    if (numbers[k] >= 0) {
      ends[numbers[k]] = v;
    } else {
      bonds.add_around(static_cast<std::size_t>(-1 - numbers[k]), v);
    }
  }
  for (auto end = ends.begin(); end != ends.end(); ++end) {
    const Vec3 from = end->second;
    if (++end == ends.end()) break;
    const std::size_t chain = chains.chain_at(static_cast<std::int32_t>(end->first / 2));
    bonds.add(chain, chains.chains().closed(chain), from, end->second);
  }
}

}  // namespace

bool BondCheck::are_determined(const ChainMap& map, const NearBeads& beads, const dch::Box& box) {
  const dch::necklace::Necklace& chains = map.chains();
  const auto processes = static_cast<std::size_t>(comm->nprocs);
  const OwnPlaces own(map, beads);
  Bonds bonds(box);
  std::vector<std::vector<double> > parts(processes);
  const auto send = [&](std::size_t chain, double what, Vec3 v) {
    auto& part = parts[chain % processes];
    part.insert(part.end(), {what, v.x, v.y, v.z});
  };
  own.for_each([&](std::int32_t place, Vec3 at) {
    const std::size_t chain = chains.chain_at(place);
    const std::int32_t first = chains.first_place(chain), last = chains.first_place(chain + 1) - 1;
    const bool closed = chains.chains().closed(chain);
    if (place < last || closed) {
      if (const Vec3* const next = own.at(place < last ? place + 1 : first)) {
        bonds.add(chain, closed, at, *next);
      } else {
        send(chain, 2.0 * place, at);
      }
    }
    if (place == first && !closed) return;
    const std::int32_t previous = place > first ? place - 1 : last;
    if (own.at(previous) == nullptr) send(chain, 2.0 * previous + 1, at);
  });
  for (const auto& [ring, sum] : bonds.around()) send(ring, -1.0 - static_cast<double>(ring), sum);
  bytes_ = 0;
  for (std::size_t p = 0; p < processes; ++p)
    if (p != static_cast<std::size_t>(comm->me))
      bytes_ += static_cast<bigint>(parts[p].size() * sizeof(double));

  Bonds met(box);
  add_received(exchange(parts, *error, world), chains, met);
  for (const auto& [ring, sum] : met.around()) met.look_at(sum);
  return bonds.sound() && met.sound();
}

}  // namespace LAMMPS_NS

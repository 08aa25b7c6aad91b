// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch with a search that makes one mistake, to see that `dch verify` finds it:
//     lmp_faulty drop|repeat|none [LAMMPS options]
// From its third list on the search leaves a pair of owned atoms out, or lists the one after it in its place
// as well. (Of a pair with a ghost LAMMPS uses one of two copies, which need not be the first.)
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <input.h>
#include <lammps_host.h>
#include <memory>
#include <string>

#include <dch/engines/pair_search.hpp>

#include "dch_command.h"
#include "dch_register.h"
#include "neighbor_dch.h"

namespace {

enum class Fault { none, drop, repeat };
Fault fault = Fault::none;

class FaultySearch : public dch::PairSearch {
 public:
  explicit FaultySearch(const dch::HierarchyParams& params) : good_(dch::make_dch_search(params)) {}

  void update(dch::Span<const dch::Vec3> positions, const dch::Box& box,
              dch::Span<const std::uint64_t> keys) override {
    good_->update(positions, box, keys);
  }
  void list(const dch::ListParams& params, dch::NeighborList& out) override {
    good_->list(params, out);
    if (++lists_ < 3) return;
    if (fault == Fault::none) return;
    const auto [row, k] = first_two_owned(
        out, params.first_ghost < 0 ? static_cast<std::int32_t>(out.size()) : params.first_ghost);
    if (fault == Fault::repeat) {
      out.j[k] = out.j[k + 1];
      return;
    }
    out.j.erase(out.j.begin() + static_cast<std::ptrdiff_t>(k));
    for (std::size_t after = row; after < out.size(); ++after) --out.first[after + 1];
  }
  const dch::SearchStats& stats() const override { return good_->stats(); }
  std::string name() const override { return "faulty"; }

 private:
  struct Entry {
    std::size_t row, k;
  };
  /// The first entry of a list that, like the one after it in its row, pairs two owned atoms.
  static Entry first_two_owned(const dch::NeighborList& list, std::int32_t first_ghost) {
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (list.particle[row] >= first_ghost) continue;
      for (auto k = list.first[row]; k + 1 < list.first[row + 1]; ++k)
        if (list.j[k] < first_ghost && list.j[k + 1] < first_ghost) return {row, static_cast<std::size_t>(k)};
    }
    std::fprintf(stderr, "no row with two owned neighbors to plant the fault in\n");
    std::abort();
  }

  std::unique_ptr<dch::PairSearch> good_;
  int lists_ = 0;
};

std::unique_ptr<dch::PairSearch> make_faulty(const std::string&, const dch::HierarchyParams& params) {
  return std::make_unique<FaultySearch>(params);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::string kind = argc > 1 ? argv[1] : "";
  fault = kind == "drop" ? Fault::drop : kind == "repeat" ? Fault::repeat : Fault::none;
  auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc - 1, argv + 1, MPI_COMM_WORLD);
  if (dch_register(lammps.get()) != 0) return 1;
  LAMMPS_NS::NeighborDCH::install(lammps.get(), {make_faulty});
  lammps->input->file();
  lammps.reset();
  MPI_Finalize();
  return 0;
}

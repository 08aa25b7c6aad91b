// SPDX-License-Identifier: GPL-2.0-or-later
// lmp-dch with a search that makes one mistake, to see that `dch verify` finds it:
//     lmp_faulty drop|repeat|none [LAMMPS options]
// From its third list on the search leaves the first pair out, or lists the second pair of a row in its place
// as well.
#include <cstdio>
#include <cstring>
#include <input.h>
#include <lammps_host.h>
#include <memory>
#include <string>

#include <dch/hierarchy.hpp>

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
    if (fault == Fault::drop) drop_first_pair(out);
    if (fault == Fault::repeat) repeat_second_pair(out);
  }
  const dch::SearchStats& stats() const override { return good_->stats(); }
  std::string name() const override { return "faulty"; }

 private:
  static std::size_t first_row(const dch::NeighborList& list) {
    std::size_t row = 0;
    while (list.first[row + 1] == 0) ++row;
    return row;
  }
  static void drop_first_pair(dch::NeighborList& list) {
    list.j.erase(list.j.begin());
    for (std::size_t row = first_row(list); row < list.size(); ++row) --list.first[row + 1];
  }
  static void repeat_second_pair(dch::NeighborList& list) { list.j[0] = list.j[1]; }

  std::unique_ptr<dch::PairSearch> good_;
  int lists_ = 0;
};

std::unique_ptr<dch::PairSearch> make_faulty(const dch::HierarchyParams& params) {
  return std::make_unique<FaultySearch>(params);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::string kind = argc > 1 ? argv[1] : "";
  fault = kind == "drop" ? Fault::drop : kind == "repeat" ? Fault::repeat : Fault::none;
  auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc - 1, argv + 1, MPI_COMM_WORLD);
  if (dch_register(lammps.get()) != 0) return 1;
  LAMMPS_NS::NeighborDCH::install(lammps.get(), make_faulty);
  lammps->input->file();
  lammps.reset();
  MPI_Finalize();
  return 0;
}

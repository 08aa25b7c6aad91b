// SPDX-License-Identifier: GPL-2.0-or-later
// What pair styles of ours do alike beside a plain style, or in place of one.
#pragma once

#include <cstdint>
#include <error.h>
#include <lammps_host.h>
#include <memory>
#include <new>
#include <pair.h>
#include <string>

#include <dch/base/error.hpp>

#include "explained.h"

namespace LAMMPS_NS {

/// Makes the arrays by pairs of types that LAMMPS looks into, unless they are there.
void make_arrays_by_types(Pair& style, int types, Memory& memory);
void give_up_arrays_by_types(Pair& style, Memory& memory);

/// A pair style whose forces are its own. Everything else is the plain style's, of which it keeps an object:
/// arguments, coefficients, checks, cutoffs, single().
class PlainPair : public Pair, public Explained {
 public:
  ~PlainPair() override;
  PlainPair(const PlainPair&) = delete;
  PlainPair& operator=(const PlainPair&) = delete;

  void init_list(int id, NeighList* neighbors) override;
  double init_one(int i, int j) override;
  void modify_params(int narg, char** arg) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                double& fforce) override;
  void* extract(const char* name, int& dimension) override;
  void add_tally_callback(Compute* compute) override;
  void del_tally_callback(Compute* compute) override;
  double memory_usage() override;
  void choose() override { is_chosen_ = true; }

 protected:
  PlainPair(LAMMPS* lammps, const char* plain) : Pair(lammps), plain_name_(plain) {}
  /// @param package  without which LAMMPS lacks the plain style, for a message; or empty
  void make_plain(const std::string& package = {});

  Pair& plain() const { return *plain_; }
  std::string name() const { return plain_name_ + "/dch"; }
  /// For messages.
  std::string title() const { return "Pair style " + name(); }

  /// Says which pairs of types have been given to the plain style, if it has arrays.
  void take_flags_by_types();
  /// Takes the lists that the plain style asks for.
  void init_plain_with_lists();
  void compute_plain(int eflag, int vflag);
  /// What the plain style has computed, which has been asked for the same.
  void take_sums_of_plain();
  /// Why the plain style computes, if it does, or else how forces are computed, if they have been.
  dch::lammps::StyleNote note(const std::string& how) const;
  /// Does what may fail in the library, on some processes only.
  template <class Work>
  void stop_if_it_fails(const Work& work) {
    try {
      work();
    } catch (const dch::Error& e) {
      error->one(FLERR, title() + ": " + e.what());
    } catch (const std::bad_alloc&) {
      error->one(FLERR, title() + ": out of memory; use more processes");
    }
  }

  std::string plain_name_;
  std::unique_ptr<Pair> plain_;
  bool is_chosen_ = false;          ///< by `dch on`, not by the script
  dch::lammps::Obstacle obstacle_;  ///< why the plain style computes
  std::int64_t computed_ = 0;       ///< how often in this run
};

}  // namespace LAMMPS_NS

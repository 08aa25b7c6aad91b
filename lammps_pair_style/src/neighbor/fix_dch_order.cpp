// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_dch_order.h"

#include <cstring>
#include <modify.h>

#include "neighbor_dch.h"

namespace LAMMPS_NS {
namespace {

/// Names of protected members.
struct Calls : Modify {
  using Modify::list_init;
  using Modify::list_min_pre_exchange;
  using Modify::list_pre_exchange;
};

}  // namespace

int FixDCHOrder::index_in(const Modify& modify) {
  for (int k = 0; k < modify.nfix; ++k)
    if (std::strcmp(modify.fix[k]->style, kStyle) == 0) return k;
  return -1;
}

void FixDCHOrder::install(LAMMPS* lammps) {
  Modify& modify = *lammps->modify;
  if (index_in(modify) >= 0) return;
  (*modify.fix_map)[kStyle] = [](LAMMPS* lmp, int narg, char** arg) -> Fix* {
    return new FixDCHOrder(lmp, narg, arg);
  };
  modify.add_fix(std::string(kStyle) + " all " + kStyle, 0);
  // Modify::init() has made its lists of whom to call already.
  (modify.*(&Calls::list_init))(FixConst::PRE_EXCHANGE, modify.n_pre_exchange,
                                modify.*(&Calls::list_pre_exchange));
  (modify.*(&Calls::list_init))(FixConst::MIN_PRE_EXCHANGE, modify.n_min_pre_exchange,
                                modify.*(&Calls::list_min_pre_exchange));
}

int FixDCHOrder::setmask() { return FixConst::PRE_EXCHANGE | FixConst::MIN_PRE_EXCHANGE; }

void FixDCHOrder::setup_pre_exchange() {
  if (auto* ours = dynamic_cast<NeighborDCH*>(neighbor)) {
    ours->restore_order();
    ours->leave_out_ghosts();
  }
}

void FixDCHOrder::pre_exchange() {
  if (auto* ours = dynamic_cast<NeighborDCH*>(neighbor)) {
    ours->order_atoms();
    ours->leave_out_ghosts();
  }
}

}  // namespace LAMMPS_NS

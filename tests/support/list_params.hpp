// SPDX-License-Identifier: MIT
#pragma once

#include <dch/lists/list_params.hpp>

namespace dch {

/// All pairs within the cutoff, whatever their types.
inline ListParams within(double cutoff, ListKind kind = ListKind::half) {
  ListParams params;
  params.cutoffs = TypeCutoffs(cutoff);
  params.kind = kind;
  return params;
}

inline ListParams within_skin(double cutoff, double skin) {
  ListParams params = within(cutoff);
  params.skin = skin;
  return params;
}

}  // namespace dch

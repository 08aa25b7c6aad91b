// SPDX-License-Identifier: MIT
#pragma once

#include <dch/hierarchy/hierarchy.hpp>

#include "hierarchy/hierarchy_impl.hpp"

namespace dch {

/// Lets tests plant faults and costs inside a hierarchy.
struct HierarchyTestAccess {
  using Impl = Hierarchy::Impl;
  static Impl& impl(Hierarchy& h) { return *h.impl_; }
};

}  // namespace dch

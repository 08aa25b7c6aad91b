// SPDX-License-Identifier: MIT
#pragma once

#include <dch/base/instruction_set.hpp>

#include "simd/contact_task.hpp"

namespace dch::detail {

/// The loops of contacts, compiled for one instruction set.
struct ContactKernels {
  void (*hooke)(const ContactTask& task);
  void (*hooke_history)(const ContactTask& task);
  void (*hertz_history)(const ContactTask& task);
};

/// The kernels of a set that is supported.
const ContactKernels& contact_kernels(InstructionSet set);

}  // namespace dch::detail

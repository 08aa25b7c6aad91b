// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdlib>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>

namespace dch {
namespace {

constexpr InstructionSet kWidestFirst[] = {InstructionSet::avx512, InstructionSet::avx2,
                                           InstructionSet::sse42, InstructionSet::neon,
                                           InstructionSet::portable};

std::string supported_names() {
  std::string names;
  for (const InstructionSet set : kWidestFirst)
    if (is_supported(set)) names += (names.empty() ? "" : ", ") + name(set);
  return names;
}

InstructionSet choose() {
  const char* variable = std::getenv("DCH_FORCE_ISA");
  const std::string forced = variable ? variable : "";
  for (const InstructionSet set : kWidestFirst) {
    if (!forced.empty() ? name(set) != forced : !is_supported(set)) continue;
    if (!is_supported(set))
      throw InvalidParameter("DCH_FORCE_ISA is '" + forced +
                             "', which this processor or build does not support; choose one of " +
                             supported_names());
    return set;
  }
  throw InvalidParameter("DCH_FORCE_ISA is '" + forced + "', which is unknown; choose one of " +
                         supported_names());
}

std::atomic<int>& chosen() {
  static std::atomic<int> set{static_cast<int>(choose())};  // a choice that throws is made again next time
  return set;
}

}  // namespace

bool is_supported(InstructionSet set) {
#ifdef DCH_X86_KERNELS
  switch (set) {
    case InstructionSet::portable:
      return true;
    case InstructionSet::sse42:
      return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
    case InstructionSet::avx512:
      return is_supported(InstructionSet::avx2) && __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vbmi2");
    case InstructionSet::neon:
      return false;
  }
  return false;
#elif defined(DCH_NEON_KERNELS)
  return set == InstructionSet::portable || set == InstructionSet::neon;
#else
  return set == InstructionSet::portable;
#endif
}

InstructionSet instruction_set() {
  return static_cast<InstructionSet>(chosen().load(std::memory_order_relaxed));
}

void set_instruction_set(InstructionSet set) {
  if (!is_supported(set))
    throw InvalidParameter("instruction set " + name(set) +
                           " is not supported by this processor or build; choose one of " +
                           supported_names());
  chosen().store(static_cast<int>(set), std::memory_order_relaxed);
}

std::string name(InstructionSet set) {
  switch (set) {
    case InstructionSet::portable:
      return "portable";
    case InstructionSet::sse42:
      return "sse4.2";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::neon:
      return "neon";
  }
  return "unknown";
}

}  // namespace dch

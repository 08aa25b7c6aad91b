// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <vector>

#include <dch/base/instruction_set.hpp>

namespace dch {

inline std::ostream& operator<<(std::ostream& out, InstructionSet set) { return out << name(set); }

/// Those that there are for processors of this kind.
#ifdef __aarch64__
inline constexpr InstructionSet kInstructionSets[] = {InstructionSet::portable, InstructionSet::neon};
#else
inline constexpr InstructionSet kInstructionSets[] = {InstructionSet::portable, InstructionSet::sse42,
                                                      InstructionSet::avx2, InstructionSet::avx512};
#endif

/// What this processor runs, the widest last.
inline std::vector<InstructionSet> supported_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : kInstructionSets)
    if (is_supported(set)) sets.push_back(set);
  return sets;
}

/// Puts back the instruction set that was in use.
class RestoreInstructionSet {
 public:
  RestoreInstructionSet() = default;
  ~RestoreInstructionSet() { set_instruction_set(before_); }
  RestoreInstructionSet(const RestoreInstructionSet&) = delete;
  RestoreInstructionSet& operator=(const RestoreInstructionSet&) = delete;

 private:
  InstructionSet before_ = instruction_set();
};

}  // namespace dch

// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#pragma GCC visibility push(default)
namespace dch {

/// Instruction sets that the inner loops are compiled for. All of them give the same lists, bit for bit.
enum class InstructionSet {
  portable,  ///< plain C++ for any processor
  sse42,     ///< x86-64-v2
  avx2,      ///< x86-64-v3
  avx512,    ///< F, BW, VL, DQ and VBMI2
  neon       ///< 128 bits, which every processor of AArch64 has
};

/// Whether this build holds code for the set and the processor runs it.
bool is_supported(InstructionSet set);

/// The set in use: the widest supported one, or what the environment variable DCH_FORCE_ISA names (portable,
/// sse4.2, avx2, avx512, neon).
/// @throws InvalidParameter if DCH_FORCE_ISA names an unknown set, or one that is not supported here.
InstructionSet instruction_set();

/// Uses another set from here on, in the whole process. Not to be called while lists are being made.
/// @throws InvalidParameter if it is not supported here.
void set_instruction_set(InstructionSet set);

/// "portable", "sse4.2", "avx2", "avx512", "neon".
std::string name(InstructionSet set);

}  // namespace dch
#pragma GCC visibility pop

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

namespace trismooth {

/// The instructions that the hottest loops are compiled for, beside those that every processor of its family has. Only
/// speed depends on them: the bits of every result are the same.
enum class InstructionSet {
  baseline,  ///< what the compiler was told to use: of x86-64 SSE2, if nothing was said
  avx2       ///< registers of 32 bytes
};

inline constexpr std::array<std::string_view, 2> instruction_set_names{"baseline", "avx2"};

/// The best one that this processor has, unless limit_instruction_set() or the environment variable
/// TRISMOOTH_INSTRUCTION_SET, which holds one of the names, says less.
InstructionSet instruction_set();

/// No better one is used from now on. For tests, and for who looks for a fault: it is of the whole process.
void limit_instruction_set(InstructionSet most);

}  // namespace trismooth

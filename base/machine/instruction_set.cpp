// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/instruction_set.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>

namespace trismooth {

namespace {

InstructionSet of_processor() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? InstructionSet::avx2 : InstructionSet::baseline;
#else
  return InstructionSet::baseline;
#endif
}

/// The best one, where the environment names none.
InstructionSet of_environment() {
  const char* const value = std::getenv("TRISMOOTH_INSTRUCTION_SET");
  const auto* const named = std::ranges::find(instruction_set_names, value == nullptr ? "" : std::string_view(value));
  return named == instruction_set_names.end() ? InstructionSet::avx2
                                              : static_cast<InstructionSet>(named - instruction_set_names.begin());
}

std::atomic<InstructionSet>& limit() {
  static std::atomic<InstructionSet> most = std::min(of_processor(), of_environment());
  return most;
}

}  // namespace

InstructionSet instruction_set() {
  return limit();
}

void limit_instruction_set(InstructionSet most) {
  limit() = std::min(of_processor(), most);
}

}  // namespace trismooth

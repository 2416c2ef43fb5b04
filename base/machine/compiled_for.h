// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/machine/instruction_set.h"

namespace trismooth {

namespace instruction_sets {

template <auto function, class Result, class... Arguments>
[[gnu::flatten]] Result baseline(Arguments... arguments) {
  return function(arguments...);
}

#if defined(__x86_64__)
template <auto function, class Result, class... Arguments>
[[gnu::flatten, gnu::target("avx2")]] Result avx2(Arguments... arguments) {
  return function(arguments...);
}
#endif

template <auto function, class Result, class... Arguments>
auto choose([[maybe_unused]] InstructionSet instructions, Result (* /*type*/)(Arguments...)) {
#if defined(__x86_64__)
  if (instructions == InstructionSet::avx2) {
    return &avx2<function, Result, Arguments...>;
  }
#endif
  return &baseline<function, Result, Arguments...>;
}

}  // namespace instruction_sets

/// A pointer to what `function` is where it is compiled for these instructions. All that it calls is inlined into it,
/// so that no code for one set ends up in another's functions: take one that is a loop over many, and that calls
/// nothing but formulas. GCC makes vectors of a loop over arrays of fixed size that has no branches: & and | in place
/// of && and ||, no early exit, and what is yes or no kept in numbers as wide as the others.
///
///     void add_all(Numbers& numbers) { for (int i = 0; i < Numbers::count; ++i) ... }
///     const auto add = compiled_for<add_all>();
template <auto function>
auto compiled_for(InstructionSet instructions = instruction_set()) {
  return instruction_sets::choose<function>(instructions, function);
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/base/machine/compiled_for.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "catch.h"

using trismooth::compiled_for;
using trismooth::InstructionSet;

namespace {

struct Numbers {
  std::array<double, 32> in{};
  std::array<double, 32> out{};
};

int divide_all(double dividend, Numbers& numbers) {
  for (std::size_t i = 0; i < numbers.in.size(); ++i) {
    numbers.out[i] = dividend / numbers.in[i];
  }
  return 7;
}

}  // namespace

TEST_CASE("a function compiled for any instruction set does what it does, to the bit") {
  Numbers plain;
  for (std::size_t i = 0; i < plain.in.size(); ++i) {
    plain.in[i] = 3.0 * static_cast<double>(i) + 1;
  }
  divide_all(0.1, plain);
  for (const InstructionSet most : {InstructionSet::baseline, InstructionSet::avx2}) {
    Numbers numbers{plain.in, {}};
    // The best that the processor has may be less than `most`.
    const auto divide = compiled_for<divide_all>(std::min(most, trismooth::instruction_set()));
    CHECK(divide(0.1, numbers) == 7);
    CHECK(numbers.out == plain.out);
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trismooth/base/machine/instruction_set.h"

/// Has the process use no better instructions, for as long as it lives.
class LimitedInstructions {
 public:
  explicit LimitedInstructions(trismooth::InstructionSet most) : before_(trismooth::instruction_set()) {
    trismooth::limit_instruction_set(most);
  }
  LimitedInstructions(const LimitedInstructions&) = delete;
  LimitedInstructions& operator=(const LimitedInstructions&) = delete;
  ~LimitedInstructions() { trismooth::limit_instruction_set(before_); }

 private:
  trismooth::InstructionSet before_;
};

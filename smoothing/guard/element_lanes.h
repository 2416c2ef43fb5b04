#pragma once

#include "trismooth/base/machine/instruction_set.h"

namespace trismooth {

/// Elements side by side, an element a lane, and what the never-worse guard has to know of them. Loops over lanes do in
/// one instruction what a register has room for.
struct ElementLanes {
  static constexpr int lanes = 64;
  /// Loops go over so many at a time.
  static constexpr int at_once = 8;

  // In: the corners, in canonical order. Lanes beyond those in use hold anything.
  alignas(64) double before_x[3][lanes] = {};
  alignas(64) double before_y[3][lanes] = {};
  alignas(64) double after_x[3][lanes] = {};
  alignas(64) double after_y[3][lanes] = {};
  // Out.
  alignas(64) double quotients[lanes] = {};  ///< before; infinite where no corner has moved
  alignas(64) double worsened[lanes] = {};   ///< worsened_quotient(); likewise
};

/// Fills in what is asked for of the first `count` lanes.
using ElementMeasure = void (*)(int count, ElementLanes& elements);

/// The one that uses these instructions: every one gives the bits of shape_quotient() and of worsened_quotient().
ElementMeasure element_measure(InstructionSet instructions);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "trismooth/base/machine/instruction_set.h"
#include "trismooth/quality/element.h"

namespace trismooth {

/// Elements of one kind side by side, triangles (Triangle) or quadrilaterals (MixedElement), an element a lane, and
/// what the never-worse guard has to know of them. Loops over lanes do in one instruction what a register has room for.
template <class Corners>
struct ElementLanes {
  static constexpr int lanes = 64;
  static constexpr int corners = std::tuple_size_v<Corners>;
  /// Loops go over so many at a time.
  static constexpr int at_once = 8;

  // In: the corners, in canonical order. Lanes beyond those in use hold anything.
  alignas(64) double before_x[corners][lanes] = {};
  alignas(64) double before_y[corners][lanes] = {};
  alignas(64) double after_x[corners][lanes] = {};
  alignas(64) double after_y[corners][lanes] = {};
  // Out.
  alignas(64) double quotients[lanes] = {};  ///< before; infinite where no corner has moved
  alignas(64) double worsened[lanes] = {};   ///< worsened_quotient(); likewise
};

/// Fills in what is asked for of the first `count` lanes.
template <class Corners>
using ElementMeasure = void (*)(int count, ElementLanes<Corners>& elements);

/// The one that uses these instructions: every one gives the bits of shape_quotient() and of worsened_quotient().
template <class Corners>
ElementMeasure<Corners> element_measure(InstructionSet instructions);

}  // namespace trismooth

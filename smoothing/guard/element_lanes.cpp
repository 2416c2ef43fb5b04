// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/guard/element_lanes.h"

#include <limits>

#include "trismooth/base/machine/compiled_for.h"
#include "trismooth/smoothing/guard/guard_rule.h"

// Loops that call the formulas as they are for each lane, inlined into a function for each instruction set.
namespace trismooth {

namespace {

/// 1 where the numbers are not the same, else 0. Their sum says "or" in a way that GCC makes no branches of.
[[gnu::always_inline]] inline double differ(double a, double b) {
  return a == b ? 0.0 : 1.0;
}

template <class Corners>
using InLanes = double[ElementLanes<Corners>::corners][ElementLanes<Corners>::lanes];

[[gnu::always_inline]] inline double quotient_in_lane(const InLanes<Triangle>& x, const InLanes<Triangle>& y,
                                                      int lane) {
  return shape_quotient<double>({x[0][lane], y[0][lane]}, {x[1][lane], y[1][lane]}, {x[2][lane], y[2][lane]});
}
[[gnu::always_inline]] inline double quotient_in_lane(const InLanes<MixedElement>& x, const InLanes<MixedElement>& y,
                                                      int lane) {
  return shape_quotient<double>({x[0][lane], y[0][lane]}, {x[1][lane], y[1][lane]}, {x[2][lane], y[2][lane]},
                                {x[3][lane], y[3][lane]});
}

/// (Three loops: of all in one, GCC makes branches.)
template <class Corners>
void measure_elements(int count, ElementLanes<Corners>& elements) {
  // To the end of a register: a rest would need code of its own.
  constexpr int at_once = ElementLanes<Corners>::at_once;
  const int end = (count + at_once - 1) / at_once * at_once;
  for (int lane = 0; lane < end; ++lane) {
    elements.quotients[lane] = quotient_in_lane(elements.before_x, elements.before_y, lane);
    elements.worsened[lane] = quotient_in_lane(elements.after_x, elements.after_y, lane);
  }
  for (int lane = 0; lane < end; ++lane) {
    elements.worsened[lane] = worsened_quotient(elements.quotients[lane], elements.worsened[lane]);
  }
  for (int lane = 0; lane < end; ++lane) {
    double moved = 0;
    for (int corner = 0; corner < ElementLanes<Corners>::corners; ++corner) {
      moved += differ(elements.before_x[corner][lane], elements.after_x[corner][lane]);
      moved += differ(elements.before_y[corner][lane], elements.after_y[corner][lane]);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    elements.quotients[lane] = moved != 0 ? elements.quotients[lane] : infinity;
    elements.worsened[lane] = moved != 0 ? elements.worsened[lane] : infinity;
  }
}

}  // namespace

template <class Corners>
ElementMeasure<Corners> element_measure(InstructionSet instructions) {
  return compiled_for<measure_elements<Corners>>(instructions);
}

template ElementMeasure<Triangle> element_measure(InstructionSet instructions);
template ElementMeasure<MixedElement> element_measure(InstructionSet instructions);

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>

#include "trismooth/all_methods.h"
#include "trismooth/base/enum_text.h"
#include "trismooth/smoothing/method.h"
#include "trismooth/smoothing/methods/mean_ratio_targets.h"
#include "trismooth/smoothing/methods/one_ring_update.h"

namespace trismooth {

/// A method with what it needs beside a vertex and its ring, in one stage of a smoothing.
template <class T>
struct MethodInUse {
  Method method = Method::smart;
  MeanRatioTargets<T> targets{};  ///< where the method is mean_ratio, as is the step
  MeanRatioStep<T> step{};
};

/// Calls `function` with the method's one-ring update. `first`: the methods from this one on.
template <std::size_t first = 0, class T, class Function>
decltype(auto) visit_method(const MethodInUse<T>& in_use, Function&& function) {
  constexpr auto methods = values_of<Method>();
  if constexpr (first + 1 < methods.size()) {
    if (in_use.method != methods[first]) {
      return visit_method<first + 1>(in_use, std::forward<Function>(function));
    }
  }
  return UpdateOf<methods[first]>::visit(in_use, std::forward<Function>(function));
}

}  // namespace trismooth

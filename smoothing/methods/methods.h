#pragma once

#include <utility>

#include "trismooth/smoothing/methods/laplacian.h"
#include "trismooth/smoothing/methods/mean_ratio.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/methods/weighted_laplacian.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// A method with what it needs beside a vertex and its ring, in one stage of a smoothing.
template <class T>
struct MethodInUse {
  Method method = Method::smart;
  MeanRatioTargets<T> targets{};  ///< where the method is mean_ratio, as is the step
  MeanRatioStep<T> step{};
};

/// visit_method() for mean-ratio.
template <class T, class Function>
decltype(auto) visit_mean_ratio(const MeanRatioTargets<T>& targets, const MeanRatioStep<T>& step, Function&& function) {
  if (targets.edges != nullptr) {
    return step.is_last ? function(MeanRatio<T, true, true>(targets, step))
                        : function(MeanRatio<T, true, false>(targets, step));
  }
  return step.is_last ? function(MeanRatio<T, false, true>(targets, step))
                      : function(MeanRatio<T, false, false>(targets, step));
}

/// Calls `function` with the method's one-ring update.
template <class T, class Function>
decltype(auto) visit_method(const MethodInUse<T>& in_use, Function&& function) {
  switch (in_use.method) {
    case Method::laplacian:
      return std::forward<Function>(function)(Laplacian{});
    case Method::weighted:
      return std::forward<Function>(function)(WeightedLaplacian{});
    case Method::mean_ratio:
      return visit_mean_ratio(in_use.targets, in_use.step, std::forward<Function>(function));
    case Method::smart:
      break;
  }
  return std::forward<Function>(function)(SmartLaplacian{});
}

}  // namespace trismooth

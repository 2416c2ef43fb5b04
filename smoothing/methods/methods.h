#pragma once

#include <utility>

#include "trismooth/smoothing/methods/laplacian.h"
#include "trismooth/smoothing/methods/smart_laplacian.h"
#include "trismooth/smoothing/methods/weighted_laplacian.h"
#include "trismooth/smoothing/options.h"

namespace trismooth {

/// Calls `function` with a value of the type that holds the method's one-ring update.
template <class Function>
decltype(auto) visit_method(Method method, Function&& function) {
  switch (method) {
    case Method::laplacian:
      return std::forward<Function>(function)(Laplacian{});
    case Method::weighted:
      return std::forward<Function>(function)(WeightedLaplacian{});
    case Method::smart:
      break;
  }
  return std::forward<Function>(function)(SmartLaplacian{});
}

}  // namespace trismooth

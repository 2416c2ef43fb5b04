#include "trismooth/smoothing/options.h"

#include <stdexcept>

#include "trismooth/base/machine/worker_threads.h"

namespace trismooth {

namespace {

void require(bool holds, const char* message) {
  if (!holds) {
    throw std::invalid_argument(message);
  }
}

}  // namespace

void SmoothingOptions::validate() const {
  require(max_sweeps >= 0, "the sweep limit must not be negative (0: no limit)");
  require(tolerance >= 0 && tolerance < std::numeric_limits<double>::infinity(),
          "the tolerance must be a number from 0");
  require(time_limit_seconds >= 0, "the time limit must not be negative");
  require(!target_quality || (*target_quality >= -1 && *target_quality <= 1),
          "the quality target must be from -1 to 1");
  checked_threads(threads);
  require(mean_ratio.size_weight >= 0 && mean_ratio.size_weight < std::numeric_limits<double>::infinity(),
          "the size weight must be a number from 0");
  require(mean_ratio.power >= 0 && mean_ratio.power <= 8, "the power must be from 1 to 8 (0: by the mesh)");
  require(execution == Execution::resident || method == Method::smart || method == Method::laplacian,
          "execution single-block or cdp goes with methods smart and laplacian only; execution resident goes with all");
  require(order == Order::colour || (form == Form::in_place && execution != Execution::resident),
          "order 'unordered' goes with form b and execution single-block or cdp only");
  require(layout == Layout::aos || execution != Execution::resident,
          "layout 'soa' goes with execution single-block or cdp only");
}

}  // namespace trismooth

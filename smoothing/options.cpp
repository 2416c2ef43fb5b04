// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/options.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "trismooth/base/machine/worker_threads.h"

namespace trismooth {

namespace {

void require(bool holds, const char* message) {
  if (!holds) {
    throw std::invalid_argument(message);
  }
}

/// A number from elsewhere may be none of the enumeration's.
template <class Enum>
void require_value(Enum value) {
  const auto all = values_of<Enum>();
  if (std::ranges::find(all, value) == all.end()) {
    throw std::invalid_argument(std::string(EnumText<Enum>::what) + ": there is none of the number " +
                                std::to_string(static_cast<int>(value)));
  }
}

}  // namespace

void SmoothingOptions::validate() const {
  require_value(method);
  require_value(form);
  require_value(layout);
  require_value(execution);
  require_value(order);
  require_value(topology);
  require_value(precision);
  require_value(mean_ratio.target);
  require_value(evaluation);
  require_value(untangle);
  require_value(layers);
  require(proposal.accept <= Acceptance::always, "there is no such way to accept a proposal");
  require(max_sweeps >= 0, "the sweep limit must not be negative (0: no limit)");
  require(!mean_ratio.steady || max_sweeps > 0,
          "max_sweeps: a steady smoothing, as of a mesh that moves, needs a limit from 1: its moves die away slowly");
  require(tolerance >= 0 && tolerance < std::numeric_limits<double>::infinity(),
          "the tolerance must be a number from 0");
  require(time_limit_seconds >= 0, "the time limit must not be negative");
  require(!target_quality || (*target_quality >= -1 && *target_quality <= 1),
          "the quality target (target_quality) must be a shape from -1 to 1");
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
  require(!proposal || method == Method::smart, "a proposal takes the place of the method: leave that as it is");
  require(!proposal || proposal.accept != Acceptance::lower_energy || proposal.energy,
          "a proposal that is accepted where the energy gets smaller needs an energy");
  require(!proposal.energy || (proposal && proposal.accept == Acceptance::lower_energy),
          "the energy of a proposal is for Acceptance::lower_energy, and says nothing without a place");
}

}  // namespace trismooth

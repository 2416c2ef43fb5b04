// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/mpi/same_options.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace trismooth::mpi {

std::vector<OptionValue> option_values(const SmoothingOptions& options, const Sliding& slide) {
  const auto bits = [](double value) { return std::bit_cast<std::int64_t>(value); };
  return {
      {"method", static_cast<std::int64_t>(options.method)},
      {"form", static_cast<std::int64_t>(options.form)},
      {"layout", static_cast<std::int64_t>(options.layout)},
      {"execution", static_cast<std::int64_t>(options.execution)},
      {"order", static_cast<std::int64_t>(options.order)},
      {"precision", static_cast<std::int64_t>(options.precision)},
      {"evaluation", static_cast<std::int64_t>(options.evaluation)},
      {"size_weight", bits(options.mean_ratio.size_weight)},
      {"power", options.mean_ratio.power},
      {"steady", options.mean_ratio.steady ? 1 : 0},
      {"target", static_cast<std::int64_t>(options.mean_ratio.target)},
      {"guard", options.guard ? 1 : 0},
      {"untangle", static_cast<std::int64_t>(options.untangle)},
      {"layers", static_cast<std::int64_t>(options.layers)},
      {"max_sweeps", options.max_sweeps},
      {"tolerance", bits(options.tolerance)},
      {"time_limit_seconds", bits(options.time_limit_seconds)},
      {"target_quality", bits(options.target_quality.value_or(std::numeric_limits<double>::infinity()))},
      {"record_min_shape", options.record_min_shape ? 1 : 0},
      {"backend", options.backend == nullptr ? 0 : 1},
      {"slide.along", static_cast<std::int64_t>(slide.along)},
      {"slide.corner_angle", bits(slide.corner_angle)},
      {"slide.deviation", bits(slide.deviation)},
      {"slide.curve", static_cast<std::int64_t>(slide.curve)},
      {"slide.coincident", slide.coincident ? 1 : 0},
  };
}

void require_same(std::span<const OptionValue> values, const Communicator& communicator) {
  auto to_first = lists_by_rank<std::int64_t>(communicator);
  for (const auto& [name, value] : values) {
    to_first[0].push_back(value);
  }
  const ByRank<std::int64_t> all = communicator.exchanged(std::move(to_first));
  const auto compare = [&] {
    for (std::size_t i = 0; i < values.size() && communicator.rank() == 0; ++i) {
      for (std::size_t r = 1; r < all.size(); ++r) {
        if (all[r][i] != all[0][i]) {
          throw std::invalid_argument("the option " + values[i].first + " is not the same on rank " +
                                      std::to_string(r));
        }
      }
    }
  };
  // It names the rank that it is of, which is not the one that has found it.
  communicator.on_all(compare, {library_errors().kinds});
}

}  // namespace trismooth::mpi

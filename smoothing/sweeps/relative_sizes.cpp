// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/sweeps/relative_sizes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "trismooth/base/hold.h"
#include "trismooth/base/local_frame.h"
#include "trismooth/smoothing/halo/halo.h"

namespace trismooth {

namespace {

void require_positive(const RealView& lengths, std::span<const std::uint8_t> fixed) {
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if ((fixed[v] & hold::isolated) == 0 && (!(lengths[v] > 0) || !std::isfinite(lengths[v]))) {
      throw std::invalid_argument("MeanRatioOptions::target_lengths: that of vertex " + std::to_string(v) +
                                  " is not a positive number");
    }
  }
}

}  // namespace

void require_target_lengths(const SmoothingOptions& options, std::span<const std::uint8_t> fixed) {
  const RealView& lengths = options.mean_ratio.target_lengths;
  if (!lengths.empty() && lengths.size() != fixed.size()) {
    throw std::invalid_argument("MeanRatioOptions::target_lengths has " + std::to_string(lengths.size()) +
                                " entries, expected " + std::to_string(fixed.size()) + " or none");
  }
  if (options.aims_at_sizes()) {
    require_positive(lengths, fixed);
  }
}

std::vector<double> inverse_sizes(const SmoothingOptions& options, std::span<const std::uint8_t> fixed,
                                  const Halo* halo) {
  const RealView& lengths = options.mean_ratio.target_lengths;
  if (halo == nullptr) {
    require_target_lengths(options, fixed);
  }
  if (!options.aims_at_sizes()) {
    return {};
  }
  if (halo != nullptr) {
    // (Of a part without a vertex there is one too many, so that it aims at sizes with the others.)
    require_positive(lengths, fixed);
  }
  double largest = 0;
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if ((fixed[v] & hold::isolated) == 0) {
      largest = std::max(largest, lengths[v]);
    }
  }
  largest = -least_of_parts(halo, -largest);
  std::vector<double> inverses(lengths.size(), 1);
  if (largest > 0) {
    constexpr double smallest = 0x1p-20;
    const int unit = local_frame_details::exponent_of(largest);
    for (std::size_t v = 0; v < fixed.size(); ++v) {
      if ((fixed[v] & hold::isolated) == 0) {
        const double length = std::max(smallest, local_frame_details::scaled(lengths[v], -unit));
        inverses[v] = 1 / (length * length);
      }
    }
  }
  return inverses;
}

}  // namespace trismooth

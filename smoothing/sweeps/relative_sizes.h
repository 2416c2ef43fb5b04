// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/smoothing/options.h"

namespace trismooth {

class Halo;

/// The sizes that MeanRatioOptions::target_lengths asks for, as the sweeps take them: for every vertex 1 / (area
/// relative to that of the largest length, up to a factor), from 1/4 to 2^40, since lengths below 2^-20 of the largest
/// count as that. Lengths that are all scaled by the same power of two give the same bits. Empty where none are asked
/// for or the method is another one. `fixed`: as MeshRings::fixed; vertices of no triangle get 1. Throws as
/// require_target_lengths(). `halo`: of a part of a mesh, whose largest length is that of all parts. Complexity:
/// linear.
std::vector<double> inverse_sizes(const SmoothingOptions& options, std::span<const std::uint8_t> fixed,
                                  const Halo* halo = nullptr);

/// Throws std::invalid_argument where the options name sizes and not one for each vertex, and where they aim at sizes
/// and one of a vertex of a triangle is no positive number. Complexity: linear.
void require_target_lengths(const SmoothingOptions& options, std::span<const std::uint8_t> fixed);

}  // namespace trismooth

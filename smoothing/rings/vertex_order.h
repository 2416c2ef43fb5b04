// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/smoothing/rings/one_rings.h"

namespace trismooth {

class Workers;

/// The vertices in the order in which the smoothing stores them: free ones first, each kind along a Hilbert curve, so
/// that neighbours are near each other in memory. Purely internal: no result depends on it.
/// `points` are in the local frame. Complexity: linear.
BulkVector<std::int32_t> hilbert_order(std::span<const Point2<double>> points, const OneRings& rings, Workers& workers);

}  // namespace trismooth

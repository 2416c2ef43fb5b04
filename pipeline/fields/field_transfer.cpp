// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/fields/field_transfer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "trismooth/base/exact_arithmetic.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/pipeline/fields/missing_values.h"

namespace trismooth {

namespace {

constexpr std::int64_t transfer_grain = 4096;

template <class T>
TransferredField interpolated_as(const DataArray& array, std::span<const Triangle> triangles,
                                 std::span<const std::int32_t> vertices, std::span<const MeshPlace> places,
                                 Workers& workers) {
  const std::span<const T> read = array.as<T>();
  std::vector<T> values(read.begin(), read.end());
  const MissingValues missing(array);
  std::atomic<std::int64_t> kept{0};
  workers.for_blocks(std::ssize(vertices), transfer_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const MeshPlace& place = places[i];
      if (place.triangle < 0) {
        continue;
      }
      const Triangle& triangle = triangles[place.triangle];
      bool keeps = false;
      for (std::size_t component = 0; component < array.components; ++component) {
        const auto value_at = [&](std::int32_t vertex) {
          return static_cast<double>(read[static_cast<std::size_t>(vertex) * array.components + component]);
        };
        const std::array<double, 3> corners{value_at(triangle[0]), value_at(triangle[1]), value_at(triangle[2])};
        if (missing.has_any(component, corners, place.weights)) {
          keeps = true;
          continue;
        }
        const double value = interpolated_value(corners, place.weights);
        values[static_cast<std::size_t>(vertices[i]) * array.components + component] = static_cast<T>(value);
      }
      if (keeps) {
        kept.fetch_add(1, std::memory_order_relaxed);
      }
    }
  });
  DataArray result = make_data_array(array.name, array.components, std::move(values));
  result.description = array.description;
  return {std::move(result), kept, missing.names()};
}

}  // namespace

double interpolated_value(const std::array<double, 3>& corners, const std::array<double, 3>& weights) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double value = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] > 0) {
      value += weights[i] * corners[i];
      low = std::min(low, corners[i]);
      high = std::max(high, corners[i]);
    }
  }
  // No number compares with what is none, which so stays.
  return value < low ? low : (value > high ? high : value);
}

TransferredField interpolated(const DataArray& array, std::span<const Triangle> triangles,
                              std::span<const std::int32_t> vertices, std::span<const MeshPlace> places,
                              Workers& workers) {
  return array.type == ScalarType::float32 ? interpolated_as<float>(array, triangles, vertices, places, workers)
                                           : interpolated_as<double>(array, triangles, vertices, places, workers);
}

}  // namespace trismooth

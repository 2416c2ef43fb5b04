// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trismooth/base/point2.h"
#include "trismooth/cuda/packing/vertex_order.h"
#include "trismooth/cuda/runtime/device_buffer.h"

namespace trismooth::cuda {

/// The packed numbers of vertices given by their numbers in the mesh. Waits for the device.
std::vector<std::int32_t> find_packed_numbers(Context& context, const VertexOrder& order,
                                              std::span<const std::int32_t> vertices);

/// Copies stored[vertices[i]] to gathered[i]; all is on the device.
void gather_points(const Context& context, const Point2<double>* stored, const DeviceBuffer<std::int32_t>& vertices,
                   Point2<double>* gathered);

/// Lists the fans of held vertices for the guard: fan_of[numbers[i] - free_count] = i. Others are left as they are.
void find_fans(const Context& context, const DeviceBuffer<std::int32_t>& numbers, std::int32_t free_count,
               std::int32_t* fan_of);

/// after[i] = before[free_count + i].
void copy_held(const Context& context, const Point2<double>* before, std::int32_t free_count, std::int32_t held_count,
               Point2<double>* after);
/// after[i] = before[free_count + i], but after[numbers[i] - free_count] = slid[i] for numbers from free_count on.
void place_held(const Context& context, const Point2<double>* before, std::int32_t free_count, std::int32_t held_count,
                const DeviceBuffer<Point2<double>>& slid, const DeviceBuffer<std::int32_t>& numbers,
                Point2<double>* after);

}  // namespace trismooth::cuda

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace trismooth::cuda {

/// What a caller hands over as an array of `count` elements on the device. Nothing is asked of a pointer to no
/// elements.
///
/// Throws std::invalid_argument, which says the array's name, for a null pointer and for one that is not a multiple of
/// `alignment`. Needs no device.
void require_aligned(const void* array, std::size_t count, std::size_t alignment, std::string_view name);

/// Throws std::invalid_argument for memory of the host that the current device cannot read: a kernel that touched it
/// would end all work of this process on the device. Costs a microsecond.
void require_on_device(const void* array, std::size_t count, std::string_view name);

}  // namespace trismooth::cuda

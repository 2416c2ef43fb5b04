// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "trismooth/cuda/packing/slotted_rings.h"
#include "trismooth/cuda/topology/rings.h"

/// Uses a macro with T and each type of view that resident engines have of their rings.
#define TRISMOOTH_WITH_RING_VIEWS(macro, T)      \
  macro(T, RingsView);                           \
  macro(T, SlottedMixedRingsView<std::int16_t>); \
  macro(T, SlottedMixedRingsView<std::int32_t>); \
  macro(T, SlottedRingsView<std::int16_t>);      \
  macro(T, SlottedRingsView<std::int32_t>)

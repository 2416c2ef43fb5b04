// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// Asks for the memory at `address` before it is needed, where the compiler can say so. Changes nothing else, and any
/// address will do.
inline void prefetch([[maybe_unused]] const void* address) {
#ifdef __GNUC__
  __builtin_prefetch(address);
#endif
}

}  // namespace trismooth

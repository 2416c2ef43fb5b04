// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace trismooth {

/// Gives back the memory of a vector, which `vector = {}` empties without giving back anything.
template <class Vector>
void release(Vector& vector) {
  Vector().swap(vector);
}

}  // namespace trismooth

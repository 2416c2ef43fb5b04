// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace trismooth {

/// Triangles that are no mesh to smooth: an index out of range, a triangle that repeats a vertex, a component that
/// cannot be oriented, a coordinate that is not finite.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace trismooth

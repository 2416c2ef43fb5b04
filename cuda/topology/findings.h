// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace trismooth::cuda {

/// What the kernels that find a mesh's topology report to the host.
struct Findings {
  static constexpr std::uint32_t bad_triangle = 1;  ///< an index out of range, or a vertex twice
  static constexpr std::uint32_t one_sided = 2;     ///< a component cannot be oriented
  static constexpr std::uint32_t bad_fixed_id = 4;  ///< a vertex number out of range

  std::uint32_t faults;
  std::uint32_t large_vertices;  ///< of more triangles than one thread looks after
  std::uint32_t largest_degree;
};

}  // namespace trismooth::cuda

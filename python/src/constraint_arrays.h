// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <nanobind/nanobind.h>

#include "trismooth/smoothing/constraints.h"

namespace trismooth::python {

/// The arrays that Python hands over beside points and triangles: regions, fixed, other_cells, size, lines, line_tags
/// and links. None for one that is not among them.
nanobind::handle constraint_of(const nanobind::dict& constraints, const char* name);

/// What holds vertices, what they slide along and the sizes around them, as the library takes it. Owns the arrays,
/// which are in memory of the host.
class ConstraintArrays {
 public:
  /// Raises TypeError or ValueError, with the name of the array, for one that does not fit.
  ConstraintArrays(const nanobind::dict& constraints, std::size_t vertex_count, std::size_t triangle_count);

  /// Views of the arrays, with the settings of `slide`.
  Constraints constraints(const Sliding& slide) const;
  const std::vector<double>& sizes() const { return sizes_; }

 private:
  std::vector<std::int32_t> regions_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::uint8_t> other_cells_;
  std::vector<double> sizes_;
  std::vector<std::int32_t> lines_;
  std::vector<std::int32_t> line_tags_;
  std::vector<std::int32_t> links_;
};

}  // namespace trismooth::python

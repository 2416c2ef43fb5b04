// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/smoothing/constraints.h"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace trismooth {

namespace {

void require_length(std::string_view what, std::size_t length, std::int64_t expected) {
  if (length != 0 && static_cast<std::int64_t>(length) != expected) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(length) + " entries, expected " +
                                std::to_string(expected) + " or none");
  }
}

/// `what`: how the message begins.
void require_vertices(std::string_view what, std::span<const std::int32_t> vertices, std::int32_t vertex_count) {
  for (const std::int32_t v : vertices) {
    if (v < 0 || v >= vertex_count) {
      throw std::invalid_argument(std::string(what) + " " + std::to_string(v) + " is not one of the " +
                                  std::to_string(vertex_count) + " vertices");
    }
  }
}

/// Of pairs of vertices.
void require_pairs(std::string_view what, std::span<const std::int32_t> vertices, std::int32_t vertex_count) {
  if (vertices.size() % 2 != 0) {
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(vertices.size()) +
                                " entries, expected two vertices for each");
  }
  require_vertices(std::string(what) + ": vertex", vertices, vertex_count);
}

void check_sliding(const Sliding& slide, std::int32_t vertex_count) {
  slide.validate();
  require_pairs("Sliding::lines", slide.lines, vertex_count);
  require_length("Sliding::line_tags", slide.line_tags.size(), std::ssize(slide.lines) / 2);
  require_pairs("Sliding::links", slide.links, vertex_count);
}

}  // namespace

void Sliding::validate() const {
  if (!(corner_angle >= 0 && corner_angle <= 180)) {
    throw std::invalid_argument("the corner angle of sliding is to be from 0 to 180 degrees");
  }
  if (!(deviation >= 0 && deviation <= 1)) {
    throw std::invalid_argument("the deviation of sliding is to be from 0 to 1 edge lengths");
  }
}

void check_constraints(const Constraints& constraints, std::int32_t vertex_count, std::int64_t triangle_count) {
  require_length("Constraints::fixed", constraints.fixed.size(), vertex_count);
  require_length("Constraints::other_cells", constraints.other_cells.size(), vertex_count);
  require_length("Constraints::regions", constraints.regions.size(), triangle_count);
  require_vertices("fixed vertex", constraints.fixed_ids, vertex_count);
  check_sliding(constraints.slide, vertex_count);
}

}  // namespace trismooth

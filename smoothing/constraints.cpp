#include "trismooth/smoothing/constraints.h"

#include <cstddef>
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

}  // namespace

void check_constraints(const Constraints& constraints, std::int32_t vertex_count, std::int64_t triangle_count) {
  require_length("Constraints::fixed", constraints.fixed.size(), vertex_count);
  require_length("Constraints::other_cells", constraints.other_cells.size(), vertex_count);
  require_length("Constraints::regions", constraints.regions.size(), triangle_count);
  for (const std::int32_t v : constraints.fixed_ids) {
    if (v < 0 || v >= vertex_count) {
      throw std::invalid_argument("fixed vertex " + std::to_string(v) + " is not one of the " +
                                  std::to_string(vertex_count) + " vertices");
    }
  }
}

}  // namespace trismooth

#include "trismooth/pipeline/input/middle_nodes.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "trismooth/pipeline/input/planar_mesh.h"

namespace trismooth {

namespace {

/// Calls visit(middle, ends) for the sides of all quadratic triangles.
template <class Visit>
void for_each_side(const PlanarMesh& mesh, const Visit& visit) {
  for (const QuadraticTriangle& element : mesh.quadratics) {
    const Triangle& corners = mesh.triangles[static_cast<std::size_t>(element.triangle)];
    for (std::size_t side = 0; side < 3; ++side) {
      const auto [low, high] = std::minmax(corners[side], corners[(side + 1) % 3]);
      visit(static_cast<std::size_t>(element.middles[side]), std::array<std::int32_t, 2>{low, high});
    }
  }
}

}  // namespace

void settle_middles(PlanarMesh& mesh, std::vector<std::uint8_t>& named) {
  if (mesh.quadratics.empty()) {
    return;
  }
  enum : std::uint8_t { unknown, follows, stays };
  constexpr std::array<std::int32_t, 2> no_side{-1, -1};
  std::vector<std::uint8_t> fates(mesh.in_cell.size(), unknown);
  std::vector<std::array<std::int32_t, 2>> sides(mesh.in_cell.size(), no_side);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) {
      fates[static_cast<std::size_t>(corner)] = stays;
    }
  }
  for_each_side(mesh, [&](std::size_t middle, const std::array<std::int32_t, 2>& ends) {
    const bool has_other_side = sides[middle] != no_side && sides[middle] != ends;
    const bool is_held = mesh.in_other_cell[middle] != 0 || (!named.empty() && named[middle] != 0);
    if (fates[middle] == unknown) {
      fates[middle] = is_held ? stays : follows;
    } else if (has_other_side) {
      fates[middle] = stays;
    }
    sides[middle] = ends;
  });
  std::vector<std::uint8_t>& in_other_cell = mesh.in_other_cell;
  for_each_side(mesh, [&](std::size_t middle, const std::array<std::int32_t, 2>& ends) {
    if (fates[middle] == stays) {
      in_other_cell[middle] = 1;
      std::vector<std::uint8_t>& holding = !named.empty() && named[middle] != 0 ? named : in_other_cell;
      for (const std::int32_t end : ends) {
        holding[static_cast<std::size_t>(end)] = 1;
      }
    } else if (fates[middle] == follows) {
      fates[middle] = unknown;  // listed
      in_other_cell[middle] = 1;
      mesh.middles.push_back({static_cast<std::int32_t>(middle), ends});
    }
  });
}

}  // namespace trismooth

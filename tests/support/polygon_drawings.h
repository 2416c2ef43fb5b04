// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "support/mixed_meshes.h"
#include "support/own_meshes.h"

/// OpenMesh meshes with faces of three sides, four and more.
namespace own_meshes::polygons {

using Corners = std::vector<std::int32_t>;

/// Points and faces of any number of sides.
struct Drawing {
  std::vector<double> xyz;
  std::vector<Corners> faces;
};

/// The face that two faces with one side in common become without it; nothing where they are no such two.
inline std::optional<Corners> joined(const Corners& one, const Corners& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < other.size(); ++j) {
      if (one[i] != other[(j + 1) % other.size()] || one[(i + 1) % one.size()] != other[j]) {
        continue;
      }
      Corners both;
      for (std::size_t k = 1; k <= one.size(); ++k) {
        both.push_back(one[(i + k) % one.size()]);
      }
      for (std::size_t k = 2; k < other.size(); ++k) {
        both.push_back(other[(j + k) % other.size()]);
      }
      const std::set<std::int32_t> each(both.begin(), both.end());
      return each.size() == both.size() ? std::optional(both) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// The mesh, of which so many times two faces at random have become one.
inline Drawing with_joined_faces(const mixed_meshes::MixedMesh& mesh, std::size_t times, std::uint64_t seed) {
  Drawing drawing;
  for (const auto& [x, y] : mesh.points) {
    drawing.xyz.insert(drawing.xyz.end(), {x, y, 0.25});
  }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    drawing.faces.push_back(mesh.corners(e));
  }
  std::mt19937_64 random(seed);
  std::vector<Corners>& faces = drawing.faces;
  for (std::size_t i = 0; i < times && !faces.empty(); ++i) {
    const std::size_t one = random() % faces.size();
    for (std::size_t other = 0; other < faces.size(); ++other) {
      if (const auto both = joined(faces[one], faces[other]); both && other != one) {
        faces[one] = *both;
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(other));
        break;
      }
    }
  }
  return drawing;
}

inline Drawing random_drawing(std::uint64_t seed) {
  return with_joined_faces(mixed_meshes::random_mesh(seed), seed % 5, seed);
}

/// A grid of n by n squares, some of them two triangles, with some faces of five sides and six.
inline Drawing grid_drawing(std::int32_t n, std::uint64_t seed) {
  return with_joined_faces(mixed_meshes::MixedMesh(n, n, 0.3, seed).in_another_order(seed), 6, seed);
}

template <class Mesh>
Mesh mesh_of(const Drawing& drawing, bool is_tilted = false) {
  return own_meshes::mesh_of<Mesh>(drawing.xyz, drawing.faces,
                                   [&](const Point3& p) { return is_tilted ? tilted(p) : p; });
}

/// What the mesh is as flat arrays, by its circulators.
struct Flat {
  std::vector<mixed_meshes::Element> elements;
  std::vector<int> faces;  ///< of each element
  std::vector<std::uint8_t> other_cells;
};

template <class Mesh>
Flat flat_of(const Mesh& mesh) {
  Flat flat;
  flat.other_cells.resize(mesh.n_vertices(), 0);
  for (const auto f : mesh.faces()) {
    Corners corners;
    for (const auto v : mesh.fv_range(f)) {
      corners.push_back(v.idx());
    }
    if (corners.size() <= 4) {
      flat.faces.push_back(f.idx());
      flat.elements.push_back({corners[0], corners[1], corners[2], corners.size() == 4 ? corners[3] : -1});
    } else {
      for (const std::int32_t corner : corners) {
        flat.other_cells[static_cast<std::size_t>(corner)] = 1;
      }
    }
  }
  return flat;
}

}  // namespace own_meshes::polygons

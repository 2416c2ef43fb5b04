// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "trismooth/base/element_list.h"

namespace trismooth {

/// The elements of one kind, and their numbers among all of a mesh.
template <class Corners>
struct ElementsOfKind {
  std::vector<Corners> elements;
  std::vector<std::uint8_t> reversed;
  std::vector<std::size_t> numbers;

  /// As a mesh of their own, with the points of the one that they are of.
  ElementView<Corners> view(const MeshView& mesh) const { return {mesh.points, elements, reversed, mesh.exponent}; }
};

/// The elements of a mesh by what they are.
struct ElementsByKind {
  ElementsOfKind<Triangle> triangles;
  ElementsOfKind<MixedElement> quadrilaterals;

  /// Complexity: linear.
  explicit ElementsByKind(const MeshView& mesh) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto corners = mesh.elements[e];
      if (corners.size() == 3) {
        add(triangles, {corners[0], corners[1], corners[2]}, mesh, e);
      } else {
        add(quadrilaterals, {corners[0], corners[1], corners[2], corners[3]}, mesh, e);
      }
    }
  }

 private:
  template <class Corners>
  static void add(ElementsOfKind<Corners>& kind, const Corners& corners, const MeshView& mesh, std::size_t number) {
    kind.elements.push_back(corners);
    kind.reversed.push_back(mesh.reversed.empty() ? std::uint8_t{0} : mesh.reversed[number]);
    kind.numbers.push_back(number);
  }
};

/// Calls body(view, number) for the elements of each kind: number(e) is that of element e of the view among all.
template <class Body>
void for_each_kind(const MeshView& mesh, const Body& body) {
  if (mesh.elements.are_triangles()) {
    body(TriangleView{mesh.points, mesh.elements.triangles(), mesh.reversed, mesh.exponent},
         [](std::size_t t) { return t; });
    return;
  }
  const ElementsByKind kinds(mesh);
  body(kinds.triangles.view(mesh), [&](std::size_t e) { return kinds.triangles.numbers[e]; });
  body(kinds.quadrilaterals.view(mesh), [&](std::size_t e) { return kinds.quadrilaterals.numbers[e]; });
}

}  // namespace trismooth

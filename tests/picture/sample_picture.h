// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "trismooth/pipeline/picture/mesh_picture.h"

/// Small meshes for tests of pictures.
namespace samples {

/// A square of side 2 around (1, 1), of four triangles that meet in its middle (4): below (0), right (1), above (2) and
/// left (3). All are right-angled, of shape sqrt(3) / 2.
inline trismooth::MeshPicture square() {
  trismooth::MeshPicture picture;
  for (const trismooth::Point2<double> point : {trismooth::Point2<double>{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}}) {
    picture.before.push_back(point);
  }
  picture.elements = std::vector<trismooth::Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  picture.held = {1, 1, 1, 1, 0};
  return picture;
}

/// A square of side 1, a triangle to the right of it, in two regions.
inline trismooth::MeshPicture mixed() {
  trismooth::MeshPicture picture;
  for (const trismooth::Point2<double> point : {trismooth::Point2<double>{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}}) {
    picture.before.push_back(point);
  }
  picture.elements = std::vector<trismooth::MixedElement>{{0, 1, 2, 3}, {1, 4, 2, trismooth::no_corner}};
  picture.regions = {0, 1};
  picture.region_names = {"air", "iron"};
  picture.held = {1, 1, 1, 1, 1};
  return picture;
}

}  // namespace samples

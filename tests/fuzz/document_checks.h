// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "trismooth/mesh_io/codec.h"
#include "trismooth/mesh_io/mesh_document.h"

namespace fuzz {

/// What readers promise of every document. Throws Broken.
void require_guarantees(const trismooth::MeshDocument& document);

/// What documents may differ in and be called equal.
enum class Comparison {
  exact,      ///< nothing
  converted,  ///< types of cells that say the same (a polygon of three vertices), names that were taken
};

/// The first difference; empty where there is none. Notes, the format and the original are not compared.
std::string difference(const trismooth::MeshDocument& a, const trismooth::MeshDocument& b, Comparison comparison);

/// The document with straight cells where files of the format hold no curved ones, as write_mesh() has them.
trismooth::MeshDocument straightened(const trismooth::MeshDocument& document, trismooth::FileFormat format);

/// The document with those cells alone that the format holds, in the order in which it lists them; no arrays.
trismooth::MeshDocument held_cells(const trismooth::MeshDocument& document, trismooth::FileFormat format);

/// The first difference between the points, bit for bit; empty where there is none.
std::string difference_of_points(const trismooth::MeshDocument& a, const trismooth::MeshDocument& b);

/// The first difference between what is left of the documents in STL: the corners of their triangles, in order.
std::string difference_of_corners(const trismooth::MeshDocument& a, const trismooth::MeshDocument& b);

}  // namespace fuzz

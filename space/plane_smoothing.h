// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "trismooth/base/element_list.h"
#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/smoothing/commit.h"
#include "trismooth/smoothing/options.h"
#include "trismooth/smoothing/result.h"
#include "trismooth/smoothing/rings/mesh_rings.h"
#include "trismooth/space/plane.h"

namespace trismooth {

/// Smooths points of space within their plane. `mesh` is what was found of the `elements`; its rings, the
/// most memory of all, are gone afterwards. `xyz` are the stored
/// coordinates (three of every vertex), changed in place and rounded to `storage`; `points` are plane.project() of them
/// and get the projections of the result. `local` are `points` in the local frame of those that cells use. Everything
/// else as Backend::prepare() and PreparedSmoother::smooth(). In a tilted plane the guard judges
/// the projections of what is stored, since storing rounds in space.
SmoothingResult smooth_in_plane(MeshRings& mesh, const ElementList& elements, const Plane& plane, std::span<double> xyz,
                                BulkVector<Point2<double>>& points, const LocalPoints& local, Storage storage,
                                const SmoothingOptions& options);

/// What is stored of the points of a plane, of numbers of that type.
StoredImage image_of(const Plane& plane, Storage storage);

/// Smooths points of space in any image: `points` are there, and the guard judges the images of what is stored.
/// `quadratics`, `middles`: as SweptMesh. `swept`: the type to which places in the image are rounded before they are
/// stored. All else as smooth_in_plane().
SmoothingResult smooth_in_image(MeshRings& mesh, const ElementList& elements,
                                std::span<const QuadraticElement> quadratics, std::span<const MiddleNode> middles,
                                const StoredImage& image, std::span<double> xyz, BulkVector<Point2<double>>& points,
                                const LocalPoints& local, Storage swept, const SmoothingOptions& options);

}  // namespace trismooth

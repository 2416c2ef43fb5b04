// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "trismooth/base/cell_list.h"
#include "trismooth/base/machine/bulk_memory.h"
#include "trismooth/base/point2.h"
#include "trismooth/base/storage.h"

namespace trismooth {

class Workers;

/// A plane in space with coordinates in it. Where the mesh lies along two coordinate axes, in-plane coordinates are
/// those two coordinates themselves, untouched; otherwise they are taken along two orthonormal vectors.
struct Plane {
  std::array<int, 2> axes{0, 1};  ///< the two coordinate axes; meaningful where aligned
  bool aligned = true;
  Point2<double> slope{0, 0};  ///< of an aligned plane: how the third coordinate rises along the two axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the coordinates in a tilted plane; need not lie in it
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();  ///< a point of the plane
  double deviation = 0;                            ///< how far a vertex to which it was fitted is from it, at most
  bool drops_offsets = false;                      ///< whether what moves comes to lie in the plane, wherever it was

  /// The axis across an aligned plane.
  int across() const { return 3 - axes[0] - axes[1]; }
  Eigen::Vector3d normal() const;
  /// In-plane coordinates of a point of space.
  Point2<double> project(const Eigen::Vector3d& point) const;
  /// The point of space at in-plane position `to`, given that `point` is at in-plane position `from`: the offset from
  /// the plane stays, unless the plane drops offsets. Bit-identical to `point` where `to` equals `from`; the third
  /// coordinate is, in an aligned plane without slope, wherever it moves.
  Eigen::Vector3d moved(const Eigen::Vector3d& point, Point2<double> from, Point2<double> to) const;
};

/// A point of space as it will be stored.
Eigen::Vector3d rounded_to(Storage storage, const Eigen::Vector3d& point);

/// A plane, and whether the mesh lies in it.
struct PlaneFit {
  Plane plane;
  std::int64_t outside = -1;  ///< a vertex that is too far from the plane that fits best; -1: there is none
  double distance = 0;        ///< of that vertex

  bool is_planar() const { return outside < 0; }
  /// What is wrong, for people: "the mesh is not planar: vertex 5 is ..."
  std::string fault() const;
};

/// The plane of the points (x, y, z each) whose flag in `counts` is not 0. A point lies in a plane if it is no farther
/// from it than 1e-6 of the points' largest extent, and than a tenth of the size of its smallest cell: that is the
/// largest extent of the cell, of those in `cells` (none: there is no such limit) that have any. Rounding of
/// coordinates to `storage` is no fault.
///
/// Two coordinate axes where the points lie in their plane, and no other plane fits more than twice as well; where one
/// does and is inclined by up to 1e-6, the same two axes, with its slope. Otherwise the plane of least squares. The
/// axes are those of the two largest extents (of equal ones xy before xz before yz). No points: xy. Complexity: linear.
PlaneFit fit_plane(std::span<const double> xyz, std::span<const std::uint8_t> counts, const CellList& cells,
                   Storage storage, Workers& workers);

/// fit_plane() on the calling thread, of points that all count.
PlaneFit fit_plane(std::span<const double> xyz, std::span<const std::uint8_t> counts, const CellList& cells,
                   Storage storage = Storage::float64);

/// The plane in which to smooth a mesh of which `plane` is that of the points that count, where it is another. Free
/// vertices far outside of the fixed ones (`fixed` not 0) give the mesh an extent of which a millionth may be much to
/// the rest, and they may all come home. So if the points leave `plane` by more than 1e-6 of the extent of the fixed
/// ones, these decide, by their own extent: not planar, or their plane, which drops offsets; `plane` itself where they
/// are on a line. Else nothing. Complexity: linear.
std::optional<PlaneFit> plane_of_fixed(const Plane& plane, std::span<const double> xyz,
                                       std::span<const std::uint8_t> counts, std::span<const std::uint8_t> fixed,
                                       Storage storage = Storage::float64);

/// All points in coordinates of the plane. Nothing if one of which `counts` has none that are finite, near the largest
/// double; others are at (0, 0) then. Complexity: linear.
std::optional<BulkVector<Point2<double>>> project(const Plane& plane, std::span<const double> xyz,
                                                  std::span<const std::uint8_t> counts, Workers& workers);

}  // namespace trismooth

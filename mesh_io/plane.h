#pragma once

#include <array>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "trismooth/quality/point2.h"

namespace trismooth {

/// A plane in space with coordinates in it. Where the mesh lies along two coordinate axes, in-plane coordinates are
/// those two coordinates themselves, untouched; otherwise they are taken along two orthonormal vectors.
struct Plane {
  std::array<int, 2> axes{0, 1};  ///< the two coordinate axes; meaningful where aligned
  bool aligned = true;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of a tilted plane
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();

  /// In-plane coordinates of a point of space.
  Point2<double> project(const Eigen::Vector3d& point) const;
  /// The point of space at in-plane position `to`, given that `point` is at in-plane position `from`: the offset from
  /// the plane stays. Bit-identical to `point` where `to` equals `from`.
  Eigen::Vector3d moved(const Eigen::Vector3d& point, Point2<double> from, Point2<double> to) const;
};

/// The plane of the points (x, y, z each): two coordinate axes where the smallest extent, along the third, is at most
/// 1e-6 of the largest (of equal ones xy before xz before yz), otherwise the plane of least squares if every point lies
/// within 1e-6 of the largest extent of it, otherwise nothing. Complexity: linear.
std::optional<Plane> fit_plane(std::span<const double> xyz);

}  // namespace trismooth

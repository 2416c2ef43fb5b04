#include "trismooth/mesh_io/plane.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

namespace trismooth {

namespace {

constexpr double flatness = 1e-6;  // of the largest extent

struct Box {
  Eigen::Vector3d half_extent;  ///< half, so that it does not overflow
  Eigen::Vector3d centre;
};

Box bounding_box(std::span<const double> xyz) {
  Eigen::Vector3d low = Eigen::Map<const Eigen::Vector3d>(xyz.data());
  Eigen::Vector3d high = low;
  for (std::size_t i = 3; i < xyz.size(); i += 3) {
    const Eigen::Map<const Eigen::Vector3d> point(xyz.data() + i);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return {high / 2 - low / 2, high / 2 + low / 2};
}

}  // namespace

Point2<double> Plane::project(const Eigen::Vector3d& point) const {
  if (aligned) {
    return {point[axes[0]], point[axes[1]]};
  }
  const Eigen::Vector3d offset = point - origin;
  return {offset.dot(u), offset.dot(v)};
}

Eigen::Vector3d Plane::moved(const Eigen::Vector3d& point, Point2<double> from, Point2<double> to) const {
  if (from == to) {
    return point;
  }
  Eigen::Vector3d result = point;
  if (aligned) {
    result[axes[0]] = to.x;
    result[axes[1]] = to.y;
  } else {
    result += u * (to.x - from.x) + v * (to.y - from.y);
  }
  return result;
}

std::optional<Plane> fit_plane(std::span<const double> xyz) {
  Plane plane;
  if (xyz.empty()) {
    return plane;
  }
  const Box box = bounding_box(xyz);
  const double size = box.half_extent.maxCoeff();
  // The thinnest side, not the first thin one: a mesh of the xz plane may be thin along z as well.
  constexpr std::array candidates{std::pair{2, std::array{0, 1}}, std::pair{1, std::array{0, 2}},
                                  std::pair{0, std::array{1, 2}}};
  const auto& [across, axes] = *std::ranges::min_element(
      candidates, {}, [&](const auto& candidate) { return box.half_extent[candidate.first]; });
  if (box.half_extent[across] <= flatness * size) {
    plane.axes = axes;
    return plane;
  }

  // In units of the size around the centre nothing overflows.
  const auto normalised = [&](std::size_t i) -> Eigen::Vector3d {
    return (Eigen::Map<const Eigen::Vector3d>(xyz.data() + i) - box.centre) / size;
  };
  const std::size_t points = xyz.size() / 3;
  const auto count = static_cast<double>(points);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    mean += normalised(i) / count;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    const Eigen::Vector3d offset = normalised(i) - mean;
    covariance += offset * offset.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    if (!(std::abs(normal.dot(normalised(i) - mean)) <= 2 * flatness)) {
      return std::nullopt;
    }
  }
  plane.aligned = false;
  plane.origin = box.centre + size * mean;
  plane.u = solver.eigenvectors().col(2);
  plane.v = normal.cross(plane.u);
  return plane;
}

}  // namespace trismooth

// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/plane.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "trismooth/base/local_frame.h"
#include "trismooth/base/machine/blocks.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/text/digits.h"

namespace trismooth {

namespace {

using Eigen::Vector3d;

constexpr std::int64_t cloud_grain = 16384;
constexpr double flatness = 1e-6;        // of the largest extent
constexpr double element_part = 0.1;     // of the size of an element
constexpr double least_inclined = 1e-6;  // where coordinates along axes would be shorter than in the plane by 5e-13

/// Half of the largest extent of each point's smallest cell; infinite where no cell of any extent is at it.
std::vector<double> half_sizes(std::span<const double> xyz, const CellList& cells) {
  std::vector<double> sizes(xyz.size() / 3, std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d high = -low;
    for (const std::int32_t v : cells[c]) {
      const Eigen::Map<const Eigen::Array3d> point(xyz.data() + 3 * static_cast<std::size_t>(v));
      low = low.min(point);
      high = high.max(point);
    }
    const double size = (high / 2 - low / 2).maxCoeff();
    if (size > 0) {
      for (const std::int32_t v : cells[c]) {
        sizes[static_cast<std::size_t>(v)] = std::min(sizes[static_cast<std::size_t>(v)], size);
      }
    }
  }
  return sizes;
}

/// How far points reach.
struct Extent {
  std::int64_t count = 0;
  Vector3d low = Vector3d::Zero();
  Vector3d high = Vector3d::Zero();

  void add(const Extent& other) {
    if (other.count > 0) {
      low = count == 0 ? other.low : low.cwiseMin(other.low).eval();
      high = count == 0 ? other.high : high.cwiseMax(other.high).eval();
      count += other.count;
    }
  }
};

/// The points to which a plane is fitted, in units of their size around their centre: there nothing overflows.
class Cloud {
 public:
  Cloud(std::span<const double> xyz, std::span<const std::uint8_t> counts, Workers& workers) : xyz_(xyz) {
    const Blocks blocks(std::ssize(counts), cloud_grain, workers);
    std::vector<Extent> extents(static_cast<std::size_t>(blocks.count()));
    blocks.for_each(workers, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      Extent extent;
      for (std::int64_t v = begin; v < end; ++v) {
        if (counts[v] != 0) {
          const Vector3d point = stored(static_cast<std::size_t>(v));
          extent.add({1, point, point});
        }
      }
      extents[block] = extent;
    });
    Extent all;
    for (const Extent& extent : extents) {
      all.add(extent);
    }
    count_ = all.count;
    low_ = all.low;
    high_ = all.high;
    half_extent_ = high_ / 2 - low_ / 2;
    centre_ = high_ / 2 + low_ / 2;
    counts_ = counts;
  }

  bool empty() const { return count_ == 0; }
  double count() const { return static_cast<double>(count_); }
  const Vector3d& low() const { return low_; }
  const Vector3d& high() const { return high_; }
  const Vector3d& centre() const { return centre_; }
  const Vector3d& half_extent() const { return half_extent_; }  ///< half, so that it does not overflow
  double half_size() const { return half_extent_.maxCoeff(); }

  Vector3d stored(std::size_t v) const { return Eigen::Map<const Vector3d>(xyz_.data() + 3 * v); }
  /// Where the point is, from the centre, in units of half the size.
  Vector3d operator[](std::size_t v) const { return (stored(v) - centre_) / half_size(); }
  /// From such a place to space.
  Vector3d in_space(const Vector3d& place) const { return centre_ + half_size() * place; }

  /// body(number, place) for all points that count.
  template <class Body>
  void for_each(const Body& body) const {
    for (std::size_t v = 0; v < counts_.size(); ++v) {
      if (counts_[v] != 0) {
        body(v, (*this)[v]);
      }
    }
  }
  /// The mean of body(place) over the points.
  template <class Value, class Body>
  Value mean(Value sum, const Body& body) const {
    for_each([&](std::size_t /*v*/, const Vector3d& place) { sum += body(place) / count(); });
    return sum;
  }

 private:
  std::span<const double> xyz_;
  std::span<const std::uint8_t> counts_;
  std::int64_t count_ = 0;
  Vector3d low_ = Vector3d::Zero();
  Vector3d high_ = Vector3d::Zero();
  Vector3d half_extent_;
  Vector3d centre_;
};

/// A plane through `foot`, in the cloud's units.
struct CloudPlane {
  Vector3d foot;
  Vector3d u;
  Vector3d normal;
  double width = 0;  ///< how far points are from the line through the foot along u, about
};

/// The direction in which the values of a matrix of covariance are largest.
template <class Matrix>
auto main_direction(const Matrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance);
  return solver.eigenvectors().col(covariance.cols() - 1).eval();
}

/// The plane of least squares. The mesh may be millions of times longer than wide, so the direction of its length is
/// found first, that of its width in its cross-section, in units of that, and what rounding has left of a slope is
/// taken out at last.
CloudPlane least_squares(const Cloud& cloud) {
  const Vector3d zero = Vector3d::Zero();
  CloudPlane plane;
  plane.foot = cloud.mean(zero, [](const Vector3d& p) { return p; });
  const auto offset = [&](const Vector3d& p) -> Vector3d { return p - plane.foot; };
  plane.u = main_direction(cloud.mean(Eigen::Matrix3d::Zero().eval(),
                                      [&](const Vector3d& p) { return (offset(p) * offset(p).transpose()).eval(); }));
  const Vector3d across_u = plane.u.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> section;
  section << across_u, plane.u.cross(across_u);
  cloud.for_each([&](std::size_t /*v*/, const Vector3d& p) {
    plane.width = std::max(plane.width, (section.transpose() * offset(p)).cwiseAbs().maxCoeff());
  });
  const double width = plane.width;
  if (width == 0) {
    plane.normal = section.col(1);
    return plane;
  }
  const auto in_section = [&](const Vector3d& p) -> Eigen::Vector2d { return section.transpose() * offset(p) / width; };
  const Eigen::Vector2d wide = main_direction(cloud.mean(Eigen::Matrix2d::Zero().eval(), [&](const Vector3d& p) {
    return (in_section(p) * in_section(p).transpose()).eval();
  }));
  const Vector3d v = section * wide;
  plane.normal = plane.u.cross(v);

  // Sums of what is nearly 0 are accurate. Along u and v they do not mix: these are the main directions.
  const auto moments = cloud.mean(Eigen::Vector4d::Zero().eval(), [&](const Vector3d& p) -> Eigen::Vector4d {
    const double along = offset(p).dot(plane.u);
    const double beside = offset(p).dot(v) / width;
    const double distance = offset(p).dot(plane.normal);
    return {along * along, beside * beside, along * distance, beside * distance};
  });
  plane.normal -= plane.u * (moments[2] / moments[0]);
  if (moments[1] > 0) {
    plane.normal -= v * (moments[3] / moments[1] / width);
  }
  plane.normal.normalize();
  plane.u = (plane.u - plane.normal * plane.normal.dot(plane.u)).normalized();
  return plane;
}

/// Whether points lie in planes.
class Judge {
 public:
  Judge(const Cloud& cloud, std::span<const double> xyz, const CellList& cells, Storage storage)
      : cloud_(cloud), xyz_(xyz), cells_(cells), storage_(storage) {}

  /// The largest distance from the plane, in the cloud's units.
  double deviation(const CloudPlane& plane) const {
    double largest = 0;
    cloud_.for_each([&](std::size_t /*v*/, const Vector3d& p) {
      largest = std::max(largest, std::abs(plane.normal.dot(p - plane.foot)));
    });
    return largest;
  }

  /// The vertex that is farthest outside of what is allowed, and its distance; -1: none is outside.
  std::pair<std::int64_t, double> outside(const CloudPlane& plane) {
    std::int64_t worst = -1;
    double worst_excess = 1;
    double worst_distance = 0;
    cloud_.for_each([&](std::size_t v, const Vector3d& p) {
      const double distance = std::abs(plane.normal.dot(p - plane.foot));
      if (distance <= rounding(v)) {
        return;
      }
      if (sizes_.empty()) {
        sizes_ = half_sizes(xyz_, cells_);
      }
      const double by_size = 2 * element_part * (sizes_[v] / cloud_.half_size());
      const double excess = distance / std::max(rounding(v), std::min(2 * flatness, by_size));
      if (!(excess <= worst_excess)) {
        worst = static_cast<std::int64_t>(v);
        worst_excess = excess;
        worst_distance = distance * cloud_.half_size();
      }
    });
    return {worst, worst_distance};
  }

 private:
  /// How far rounding may bring a point from the plane, that of its coordinates and ours.
  double rounding(std::size_t v) const {
    const double unit = storage_ == Storage::float32 ? 0x1p-24 : 0x1p-53;
    return 4 * unit * (cloud_.stored(v).cwiseAbs().maxCoeff() / cloud_.half_size()) + 0x1p-49;
  }

  const Cloud& cloud_;
  std::span<const double> xyz_;
  const CellList& cells_;
  Storage storage_;
  std::vector<double> sizes_;
};

/// The axes of the two largest extents.
std::array<int, 2> wide_axes(const Vector3d& half_extent) {
  // The thinnest side, not the first thin one: a mesh of the xz plane may be thin along z as well.
  constexpr std::array candidates{std::pair{2, std::array{0, 1}}, std::pair{1, std::array{0, 2}},
                                  std::pair{0, std::array{1, 2}}};
  return std::ranges::min_element(candidates, {}, [&](const auto& candidate) { return half_extent[candidate.first]; })
      ->second;
}

/// The origin of coordinates in a tilted plane: 0, where points that are near each other have the most digits, or near
/// the centre of points that are far from 0; subtracting either rounds nothing.
Vector3d origin_of(const Cloud& cloud) {
  constexpr double largest = 0x1p1000;
  if (cloud.half_size() > largest) {
    return cloud.centre();
  }
  Vector3d origin;
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = local_frame_details::fit_axis(cloud.low()[axis], cloud.high()[axis]).centre;
  }
  return origin;
}

}  // namespace

Eigen::Vector3d rounded_to(Storage storage, const Eigen::Vector3d& point) {
  return point.unaryExpr([storage](double coordinate) { return rounded_to(storage, coordinate); });
}

Eigen::Vector3d Plane::normal() const {
  if (!aligned) {
    return u.cross(v);
  }
  Vector3d normal = Vector3d::Zero();
  normal[axes[0]] = -slope.x;
  normal[axes[1]] = -slope.y;
  normal[across()] = 1;
  return normal.normalized();
}

Point2<double> Plane::project(const Eigen::Vector3d& point) const {
  if (aligned) {
    return {point[axes[0]], point[axes[1]]};
  }
  const Vector3d offset = point - origin;
  return {offset.dot(u), offset.dot(v)};
}

Eigen::Vector3d Plane::moved(const Eigen::Vector3d& point, Point2<double> from, Point2<double> to) const {
  if (from == to) {
    return point;
  }
  Vector3d result = point;
  if (!aligned) {
    result += u * (to.x - from.x) + v * (to.y - from.y);
    if (drops_offsets) {
      result -= normal() * normal().dot(result - foot);
    }
    return result;
  }
  result[axes[0]] = to.x;
  result[axes[1]] = to.y;
  if (drops_offsets) {
    result[across()] = foot[across()] + (slope.x * (to.x - foot[axes[0]]) + slope.y * (to.y - foot[axes[1]]));
  } else if (slope.x != 0 || slope.y != 0) {
    result[across()] += slope.x * (to.x - from.x) + slope.y * (to.y - from.y);
  }
  return result;
}

std::string PlaneFit::fault() const {
  return "the mesh is not planar: vertex " + std::to_string(outside) + " is " + general_digits(distance, 3) +
         " away from the plane that fits best, more than 1e-6 of the extent or a tenth of the size of its elements";
}

PlaneFit fit_plane(std::span<const double> xyz, std::span<const std::uint8_t> counts, const CellList& cells,
                   Storage storage) {
  Workers one(1);
  return fit_plane(xyz, counts, cells, storage, one);
}

PlaneFit fit_plane(std::span<const double> xyz, std::span<const std::uint8_t> counts, const CellList& cells,
                   Storage storage, Workers& workers) {
  PlaneFit fit;
  const Cloud cloud(xyz, counts, workers);
  if (cloud.empty()) {
    return fit;
  }
  Plane& plane = fit.plane;
  plane.axes = wide_axes(cloud.half_extent());
  plane.foot = cloud.centre();
  const double thickness = cloud.half_extent()[plane.across()];
  if (thickness == 0) {
    return fit;
  }
  Judge judge(cloud, xyz, cells, storage);
  const CloudPlane flat{Vector3d::Zero(), Vector3d::Unit(plane.axes[0]), Vector3d::Unit(plane.across())};
  const CloudPlane best = least_squares(cloud);
  const double best_deviation = judge.deviation(best);
  plane.deviation = thickness;
  if (2 * best_deviation >= thickness / cloud.half_size() && judge.outside(flat).first < 0) {
    return fit;
  }
  std::tie(fit.outside, fit.distance) = judge.outside(best);
  plane.deviation = best_deviation * cloud.half_size();
  plane.foot = cloud.in_space(best.foot);
  const Vector3d slope = best.normal / -best.normal[plane.across()];
  plane.slope = {slope[plane.axes[0]], slope[plane.axes[1]]};
  if (std::abs(plane.slope.x) <= least_inclined && std::abs(plane.slope.y) <= least_inclined) {
    return fit;
  }
  plane.slope = {0, 0};
  plane.aligned = false;
  plane.origin = origin_of(cloud);
  plane.u = best.u;
  plane.v = best.normal.cross(best.u);
  return fit;
}

namespace {

/// The side from which in-plane coordinates are seen as they are, counter-clockwise what is counter-clockwise.
Vector3d seen_from(const Plane& plane) {
  return plane.aligned ? Vector3d::Unit(plane.axes[0]).cross(Vector3d::Unit(plane.axes[1])) : plane.u.cross(plane.v);
}

/// The plane, seen from its other side.
void turn_over(Plane& plane) {
  std::swap(plane.axes[0], plane.axes[1]);
  std::swap(plane.slope.x, plane.slope.y);
  std::swap(plane.u, plane.v);
}

}  // namespace

std::optional<PlaneFit> plane_of_fixed(const Plane& plane, std::span<const double> xyz,
                                       std::span<const std::uint8_t> counts, std::span<const std::uint8_t> fixed,
                                       Storage storage) {
  if (plane.deviation == 0) {
    return std::nullopt;
  }
  std::vector<std::uint8_t> stays(counts.size());
  std::ranges::transform(counts, fixed, stays.begin(), [](std::uint8_t used, std::uint8_t held) {
    return used != 0 && held != 0 ? std::uint8_t{1} : std::uint8_t{0};
  });
  Workers one(1);
  const Cloud cloud(xyz, stays, one);
  if (plane.deviation / 2 <= flatness * cloud.half_size()) {
    return std::nullopt;
  }
  PlaneFit fit = fit_plane(xyz, stays, {}, storage);
  if (fit.is_planar()) {
    // Points on a line, or one alone, lie in many planes.
    constexpr double least_part = 1e3;
    const bool is_one =
        cloud.half_size() > 0 && least_squares(cloud).width * cloud.half_size() > least_part * plane.deviation;
    fit.plane = is_one ? fit.plane : plane;
    // How triangles are turned is known from the plane before.
    if (seen_from(fit.plane).dot(seen_from(plane)) < 0) {
      turn_over(fit.plane);
    }
    fit.plane.drops_offsets = true;
  }
  return fit;
}

std::optional<BulkVector<Point2<double>>> project(const Plane& plane, std::span<const double> xyz,
                                                  std::span<const std::uint8_t> counts, Workers& workers) {
  BulkVector<Point2<double>> points(xyz.size() / 3);
  std::atomic<bool> beyond{false};
  workers.for_blocks(std::ssize(points), cloud_grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t v = begin; v < end; ++v) {
      points[v] = plane.project(Eigen::Map<const Vector3d>(xyz.data() + 3 * v));
      if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y)) {
        if (counts[v] != 0) {
          beyond = true;
        }
        points[v] = {0, 0};
      }
    }
  });
  return beyond ? std::nullopt : std::optional(std::move(points));
}

}  // namespace trismooth

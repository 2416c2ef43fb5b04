// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "trismooth/base/point2.h"

namespace trismooth {

/// Where longitudes and latitudes lie on the map on which they are smoothed: Mercator's, on which shapes and angles are
/// those on the sphere (see mercator.h). Its units are degrees at the equator; longitudes are continuous over the mesh.
class GeographicMap {
 public:
  /// `longitudes`: of every vertex as it was read, continuous over the mesh. `west`: the lowest longitude that a vertex
  /// gets in the file when it moves; all are below west + 360.
  GeographicMap(std::vector<double> longitudes, double west) : longitudes_(std::move(longitudes)), west_(west) {}

  /// The place of a vertex that is stored there: longitude, latitude and any third number. Of those that are 360
  /// degrees apart it is the one within 180 of where the vertex was read.
  Point2<double> place(std::size_t vertex, const Eigen::Vector3d& stored) const;
  /// What is stored of the vertex when it moves on the map. The third number stays; the others have the same bits as
  /// before where they are the same on the map.
  Eigen::Vector3d moved(const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to) const;
  /// Longitude and latitude of any place.
  Point2<double> degrees(Point2<double> place) const;

 private:
  double in_file(double longitude) const;

  std::vector<double> longitudes_;
  double west_;
};

}  // namespace trismooth

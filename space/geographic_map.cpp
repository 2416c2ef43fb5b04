// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/space/geographic_map.h"

#include "trismooth/space/mercator.h"

namespace trismooth {

Point2<double> GeographicMap::place(std::size_t vertex, const Eigen::Vector3d& stored) const {
  double longitude = stored.x();
  while (longitude - longitudes_[vertex] > 180) {
    longitude -= 360;
  }
  while (longitude - longitudes_[vertex] < -180) {
    longitude += 360;
  }
  return {longitude, mercator_of_latitude(stored.y())};
}

Eigen::Vector3d GeographicMap::moved(const Eigen::Vector3d& stored, Point2<double> from, Point2<double> to) const {
  Eigen::Vector3d result = stored;
  if (to.x != from.x) {
    result.x() = in_file(to.x);
  }
  if (to.y != from.y) {
    result.y() = latitude_of_mercator(to.y);
  }
  return result;
}

Point2<double> GeographicMap::degrees(Point2<double> place) const {
  return {in_file(place.x), latitude_of_mercator(place.y)};
}

double GeographicMap::in_file(double longitude) const {
  while (longitude < west_) {
    longitude += 360;
  }
  while (longitude >= west_ + 360) {
    longitude -= 360;
  }
  return longitude;
}

}  // namespace trismooth

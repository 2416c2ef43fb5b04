// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/picture_stage.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "trismooth/pipeline/stages/run_state.h"

namespace trismooth {

namespace {

std::vector<std::int64_t> numbers_of(const std::vector<WorstElement>& worst) {
  std::vector<std::int64_t> numbers;
  std::ranges::transform(worst, std::back_inserter(numbers), &WorstElement::element);
  return numbers;
}

/// Where the points are on the map, people say longitude and latitude.
void name_places(MeshPicture& picture, const std::optional<GeographicMap>& map) {
  if (map) {
    picture.shown_place = [map](Point2<double> place) { return map->degrees(place); };
    picture.place_shown = [map](Point2<double> degrees) { return map->place(0, {degrees.x, degrees.y, 0}); };
  }
}

}  // namespace

std::shared_ptr<const MeshPicture> picture_of(const RunState& run) {
  const bool is_first = !run.result.picture;
  auto picture = is_first ? std::make_shared<MeshPicture>() : std::make_shared<MeshPicture>(*run.result.picture);
  if (!is_first) {
    picture->after = run.mesh.points;
    picture->reversed_after = run.found.reversed;
    picture->worst_after = numbers_of(run.result.after->worst);
    return picture;
  }
  picture->before = run.mesh.points;
  picture->reversed_before = run.found.reversed;
  picture->worst_before = numbers_of(run.result.before.worst);
  picture->elements = OwnElements(run.mesh.elements);
  picture->numbers = run.mesh.cells;
  if (run.regions.count() > 1) {
    picture->regions = run.regions.of_triangle;
    picture->region_names = run.regions.names;
  }
  picture->held = run.found.fixed;
  name_places(*picture, run.mesh.map);
  return picture;
}

}  // namespace trismooth

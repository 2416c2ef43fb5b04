// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/pipeline/stages/picture_stage.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "trismooth/pipeline/picture/mesh_picture.h"
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

void keep_picture(RunState& run) {
  if (!run.picture) {
    run.picture = std::make_shared<MeshPicture>();
    MeshPicture& picture = *run.picture;
    picture.before = run.mesh.points;
    picture.reversed_before = run.found.reversed;
    picture.worst_before = numbers_of(run.result.before.worst);
    picture.elements = OwnElements(run.mesh.elements);
    picture.numbers = run.mesh.cells;
    if (run.regions.count() > 1) {
      picture.regions = run.regions.of_triangle;
      picture.region_names = run.regions.names;
    }
    picture.held = run.found.fixed;
    name_places(picture, run.mesh.map);
  } else {
    constexpr long run_and_result = 2;
    if (run.picture.use_count() > run_and_result) {
      run.picture = std::make_shared<MeshPicture>(*run.picture);  // that of another step stays
    }
    run.picture->after = run.mesh.points;
    run.picture->reversed_after = run.found.reversed;
    run.picture->worst_after = numbers_of(run.result.after->worst);
  }
  run.result.picture = run.picture;
}

}  // namespace trismooth

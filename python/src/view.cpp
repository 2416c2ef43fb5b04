// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/workers.h"
#include "trismooth/base/triangle_topology.h"
#include "trismooth/pipeline/picture/mesh_view_html.h"
#include "trismooth/pipeline/report/html_page.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/options.h"
#include "trismooth/python/smoothing.h"
#include "trismooth/quality/quality_report.h"
#include "trismooth/smoothing/rings/mesh_rings.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

using Plane = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

BulkVector<Point2<double>> points_of(const Plane& plane) {
  const std::span<const Point2<double>> points(reinterpret_cast<const Point2<double>*>(plane.data()), plane.shape(0));
  return {points.begin(), points.end()};
}

/// What the elements are at these points: which are reversed, what holds vertices, and which are worst.
struct Seen {
  MeshRings rings;
  std::vector<std::int64_t> worst;
};

Seen look_at(const BulkVector<Point2<double>>& points, const ElementList& elements, const Constraints& constraints,
             Workers& workers) {
  elements.visit([&](const auto& listed) { check_triangles(static_cast<std::int32_t>(points.size()), listed); });
  std::vector<std::uint8_t> is_used(points.size(), 0);
  for (const auto corners : elements) {
    for (const std::int32_t v : corners) {
      is_used[v] = 1;
      if (!std::isfinite(points[v].x) || !std::isfinite(points[v].y)) {
        throw MeshError("vertex " + std::to_string(v) + " is not finite");
      }
    }
  }
  const LocalPoints local = local_points(
      points, [&](std::size_t v) { return is_used[v] != 0; }, workers);
  Seen seen{find_mesh_rings(local.points, elements, constraints, workers), {}};
  const QualityReport report = quality_report(
      MeshView(local.points, elements, seen.rings.reversed, local.frame.exponent), {.threads = workers.count()});
  std::ranges::transform(report.worst, std::back_inserter(seen.worst), &WorstElement::element);
  return seen;
}

/// The page that shows the mesh: `before` may be None. `triangles`: corners, as HostArray and TriangleArray take them.
std::string view_page(const std::string& title, const std::optional<Plane>& before, const Plane& after,
                      nb::handle triangles_object, nb::handle regions_object, std::vector<std::string> region_names,
                      nb::handle fixed_object, nb::handle threads_object) {
  const HostArray numbers(triangles_object, "triangles");
  const TriangleArray triangles(numbers);
  const std::size_t count = after.shape(0);
  if (before && before->shape(0) != count) {
    throw nb::value_error("points: the result has another number of them than the input");
  }
  const std::vector<std::uint8_t> fixed = vertex_flags(fixed_object, "fixed", count);
  const int threads = threads_of(threads_object);
  MeshPicture picture;
  picture.before = points_of(before ? *before : after);
  if (before) {
    picture.after = points_of(after);
  }
  picture.regions = integers(regions_object, "regions", triangles.size(), "triangles");
  picture.region_names = std::move(region_names);
  const nb::gil_scoped_release no_gil;
  return naming_arguments([&] {
    Workers workers(threads);
    picture.elements = own_elements(triangles.corners(), static_cast<std::int64_t>(count));
    const ElementList elements = picture.elements.list();
    const Constraints constraints{.fixed = fixed, .regions = picture.regions};
    Seen seen = look_at(picture.before, elements, constraints, workers);
    picture.reversed_before = std::move(seen.rings.reversed);
    picture.held = std::move(seen.rings.fixed);
    picture.worst_before = std::move(seen.worst);
    if (!picture.after.empty()) {
      Seen now = look_at(picture.after, elements, constraints, workers);
      picture.reversed_after = std::move(now.rings.reversed);
      picture.worst_after = std::move(now.worst);
    }
    return page_of(title, picture, threads);
  });
}

}  // namespace

std::string page_of(const std::string& title, const MeshPicture& picture, int threads) {
  Workers workers(threads);
  std::string body;
  add_mesh_view(body, picture, workers);
  return html_page(title, std::move(body), mesh_view_style());
}

void bind_view(nb::module_& module) {
  module.def("view_page", &view_page, "title"_a, "before"_a.none(), "after"_a, "triangles"_a, "regions"_a.none(),
             "region_names"_a, "fixed"_a.none(), "threads"_a);
}

}  // namespace trismooth::python

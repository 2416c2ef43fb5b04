// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/moving.h"

#include <optional>
#include <span>
#include <string>

#include <nanobind/stl/string.h>

#include "trismooth/python/smoothing.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

class HostMovingMesh : public PreparedMovingMesh<MovingMesh> {
 public:
  HostMovingMesh(nb::handle reference, nb::handle triangles, const nb::dict& constraints, const nb::dict& arguments)
      : PreparedMovingMesh(HostArray(reference, "points"), triangles, constraints, arguments,
                           [](std::optional<MovingMesh>& mesh, const ConstPointView& points, const IndexView& corners,
                              const Constraints& all,
                              const SmoothingOptions& options) { mesh.emplace(points, corners, all, options); }) {}

  Outcome follow(nb::handle points, nb::handle out, const std::string& start, bool with_quality,
                 const nb::object& progress, const nb::callable& accept) {
    return in_turn(progress, [&] {
      return one_step(start, [&](const auto& step) { return smooth_points(points, out, with_quality, accept, step); });
    });
  }
};

}  // namespace

void bind_moving(nb::module_& module) {
  nb::class_<HostMovingMesh>(module, "HostMovingMesh")
      .def(nb::init<nb::handle, nb::handle, const nb::dict&, const nb::dict&>(), "points"_a, "triangles"_a,
           "constraints"_a, "options"_a)
      .def("follow", &HostMovingMesh::follow, "points"_a, "out"_a, "start"_a, "quality"_a, "progress"_a.none(),
           "accept"_a)
      .def("take_back", &HostMovingMesh::take_back)
      .def("go_on_from", &HostMovingMesh::start_at, "points"_a)
      .def_prop_ro("held", &HostMovingMesh::held)
      .def_prop_ro("points", &HostMovingMesh::last_points)
      .def_prop_ro("vertex_count", &HostMovingMesh::vertex_count)
      .def_prop_ro("triangle_count", &HostMovingMesh::triangle_count);
}

}  // namespace trismooth::python

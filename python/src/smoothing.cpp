// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/smoothing.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "trismooth/python/constraint_arrays.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/host_points.h"
#include "trismooth/python/interruption.h"
#include "trismooth/python/options.h"
#include "trismooth/python/prepared_triangles.h"
#include "trismooth/python/results.h"
#include "trismooth/quality/quality.h"
#include "trismooth/smoothing/smooth.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

Outcome smooth_arrays(nb::handle points_object, nb::handle triangles_object, nb::handle out_object,
                      const nb::dict& constraints, bool with_quality, const nb::object& progress,
                      const nb::callable& accept, const nb::dict& arguments) {
  const HostArray points_array(points_object, "points");
  const PointArray points(points_array);
  const HostArray out(out_object, "out", HostArray::Access::write);
  const HostArray triangle_numbers(triangles_object, "triangles");
  const TriangleArray triangles(triangle_numbers);
  const ConstraintArrays held(constraints, points.size(), triangles.size());
  CallOptions call = parse_options(arguments);
  SmoothingOptions& options = call.smoothing;
  options.mean_ratio.target_lengths = held.sizes();
  if (triangles.may_have_middles() && call.slide.along != Slide::off) {
    raise_value_error("slide", "is for elements of corners alone; these have nodes in the middle of their sides");
  }
  Interruption interruption(progress);
  Interruption* const current = &interruption;
  Interruption::watch(options, current);
  const IndexView corners = triangles.corners();
  const Constraints all = held.constraints(call.slide);
  WorkingPoints working;
  std::function<MeshQuality()> mesh_quality;
  if (with_quality) {
    mesh_quality = [&] { return MeshQuality(static_cast<std::int64_t>(points.size()), corners, options.threads); };
  }
  return smooth_into(points_array, out, working, mesh_quality, options.threads, accept,
                     [&](const PointView& view, Outcome& outcome) {
                       if (triangles.may_have_middles()) {
                         const auto nodes = triangles.element_nodes(static_cast<std::int64_t>(points.size()));
                         outcome.smoothing = trismooth::smooth_quadratic(view, nodes, all, options);
                       } else {
                         outcome.smoothing = trismooth::smooth(view, corners, all, options);
                       }
                     });
}

/// A SmoothingPlan for Python.
class HostPlan : public PreparedTriangles {
 public:
  HostPlan(nb::handle triangles, std::size_t vertex_count, const nb::dict& constraints, const nb::dict& arguments)
      : PreparedTriangles(vertex_count, "plan") {
    prepare(triangles, constraints, arguments, {},
            [&](const IndexView& corners, const Constraints& all, const SmoothingOptions& options) {
              plan_.emplace(static_cast<std::int64_t>(vertex_count), corners, all, options);
            });
  }

  Outcome smooth(nb::handle points, nb::handle out, bool with_quality, const nb::object& progress,
                 const nb::callable& accept) {
    return in_turn(progress, [&] {
      return smooth_points(points, out, with_quality, accept, [this](const PointView& view, Outcome& outcome) {
        outcome.smoothing = plan_->smooth(view);
      });
    });
  }

 private:
  std::optional<SmoothingPlan> plan_;
};

std::vector<std::string> methods() {
  std::vector<std::string> names;
  for (const auto& [method, name] : EnumText<Method>::texts) {
    names.emplace_back(name);
  }
  return names;
}

}  // namespace

void bind_smoothing(nb::module_& module) {
  module.def("smooth", &smooth_arrays, "points"_a, "triangles"_a, "out"_a, "constraints"_a, "quality"_a,
             "progress"_a.none(), "accept"_a, "options"_a);
  module.def("option_names", &option_names);
  module.def("methods", &methods);
  nb::class_<HostPlan>(module, "HostPlan")
      .def(nb::init<nb::handle, std::size_t, const nb::dict&, const nb::dict&>(), "triangles"_a, "vertex_count"_a,
           "constraints"_a, "options"_a)
      .def("smooth", &HostPlan::smooth, "points"_a, "out"_a, "quality"_a, "progress"_a.none(), "accept"_a)
      .def_prop_ro("vertex_count", &HostPlan::vertex_count)
      .def_prop_ro("triangle_count", &HostPlan::triangle_count);
}

}  // namespace trismooth::python

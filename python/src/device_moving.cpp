// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nanobind/stl/string.h>

#include "trismooth/base/hold.h"
#include "trismooth/cuda/moving_mesh.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/python/device.h"
#include "trismooth/python/device_points.h"
#include "trismooth/python/moving.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

/// A mesh that follows its boundary in device memory, made of arrays in memory of the host. `kept`: whose the stream
/// is; work is queued there to the very end.
class DeviceMovingMesh : public PreparedMovingMesh<cuda::MovingMesh> {
 public:
  DeviceMovingMesh(nb::handle reference, nb::handle triangles, const nb::dict& constraints, int device,
                   std::uintptr_t stream, nb::handle /*kept*/, const nb::dict& arguments)
      : PreparedMovingMesh(HostArray(reference, "points"), triangles, constraints, arguments,
                           [&](std::optional<cuda::MovingMesh>& mesh, const ConstPointView& points,
                               const IndexView& corners, const Constraints& all, const SmoothingOptions& options) {
                             const cuda::DeviceScope scope(device);
                             mesh.emplace(points, corners, all, options, stream_of(stream));
                           }),
        device_(device) {
    const cuda::DeviceScope scope(device_);
    context_.emplace(stream_of(stream));
  }

  ~DeviceMovingMesh() {
    after_.begin(device_);
    mesh_.reset();
  }
  DeviceMovingMesh(const DeviceMovingMesh&) = delete;
  DeviceMovingMesh& operator=(const DeviceMovingMesh&) = delete;

  Outcome follow(nb::handle points_capsule, nb::handle out_capsule, bool is_new, const std::string& start,
                 const nb::object& progress, const nb::callable& accept) {
    DevicePoints points(points_capsule, out_capsule, is_new, device_, static_cast<std::int64_t>(vertex_count()));
    return in_turn(progress, [&] {
      return one_step(start, [&](const auto& step) {
        return points.smoothed(*context_, accept, step, [this] {
          std::vector<std::uint8_t> held = mesh_->held();
          // Where free vertices are means nothing.
          std::ranges::replace(held, std::uint8_t{0}, std::uint8_t{hold::isolated});
          return held;
        });
      });
    });
  }

  void go_on_from(nb::handle points) {
    const cuda::DeviceScope scope(device_);
    start_at(points);
  }

  nb::object points() {
    const cuda::DeviceScope scope(device_);
    return last_points();
  }

 private:
  cuda::DeviceAtEnd after_;  ///< the last to go
  int device_;
  std::optional<cuda::Context> context_;
};

}  // namespace

void bind_device_moving(nb::module_& module) {
  nb::class_<DeviceMovingMesh>(module, "DeviceMovingMesh")
      .def(nb::init<nb::handle, nb::handle, const nb::dict&, int, std::uintptr_t, nb::handle, const nb::dict&>(),
           "points"_a, "triangles"_a, "constraints"_a, "device"_a, "stream"_a, "kept"_a, "options"_a,
           nb::keep_alive<1, 7>())
      .def("follow", &DeviceMovingMesh::follow, "points"_a, "out"_a, "is_new"_a, "start"_a, "progress"_a.none(),
           "accept"_a)
      .def("take_back", &DeviceMovingMesh::take_back)
      .def("go_on_from", &DeviceMovingMesh::go_on_from, "points"_a)
      .def_prop_ro("held", &DeviceMovingMesh::held)
      .def_prop_ro("points", &DeviceMovingMesh::points)
      .def_prop_ro("vertex_count", &DeviceMovingMesh::vertex_count)
      .def_prop_ro("triangle_count", &DeviceMovingMesh::triangle_count);
}

}  // namespace trismooth::python

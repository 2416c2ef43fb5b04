// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/python/device.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>
#include <nanobind/stl/string.h>

#include "trismooth/cuda/device_mesh.h"
#include "trismooth/cuda/parts/device_scope.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_buffer.h"
#include "trismooth/python/constraint_arrays.h"
#include "trismooth/python/device_array.h"
#include "trismooth/python/device_points.h"
#include "trismooth/python/errors.h"
#include "trismooth/python/host_array.h"
#include "trismooth/python/interruption.h"
#include "trismooth/python/options.h"
#include "trismooth/python/turns.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trismooth::python {

namespace {

void require_list(const DeviceArray& array, std::int64_t count, const char* of_what) {
  if (array.dimensions() != 1 || static_cast<std::int64_t>(array.extent(0)) != count) {
    array.raise_value("shape " + array.shape_text() + "; expected (" + std::to_string(count) + ",), one for each " +
                      of_what);
  }
}

bool is_integer(const DeviceArray& array) {
  return array.kind() == 'i' || array.kind() == 'u';
}

/// A smoothing plan over arrays on a device. It keeps those that it reads again: the elements, where they are int32 one
/// behind the other; all others are copied on the device.
class DevicePlan {
 public:
  DevicePlan(nb::handle triangles_capsule, std::int64_t vertex_count, const nb::dict& constraints,
             std::uintptr_t stream, nb::handle /*kept*/, const nb::dict& arguments)
      : triangles_(triangles_capsule, "triangles"),
        device_(triangles_.device()),
        sizes_(reals(constraint_of(constraints, "size"), "size", static_cast<std::size_t>(vertex_count))) {
    if (!is_integer(triangles_)) {
      triangles_.raise_type("integers are needed, not " + triangles_.type_text());
    }
    if (triangles_.dimensions() != 2 || (triangles_.extent(1) != 3 && triangles_.extent(1) != 4)) {
      triangles_.raise_value("shape " + triangles_.shape_text() +
                             "; expected (M, 3), or (M, 4) with quadrilaterals, on a CUDA device");
    }
    mesh_.corners = static_cast<std::int32_t>(triangles_.extent(1));
    if (mesh_.corners == 4) {
      require_no_corner(triangles_);
    }
    CallOptions call = parse_options(arguments);
    SmoothingOptions& options = call.smoothing;
    options.backend = nullptr;
    options.mean_ratio.target_lengths = sizes_;
    Interruption making{nb::none()};
    interruption_ = &making;
    Interruption::watch(options, interruption_);
    mesh_.vertex_count = checked_count(vertex_count, "points");
    mesh_.element_count = checked_count(static_cast<std::int64_t>(triangles_.extent(0)), "triangles");
    const cuda::DeviceScope scope(device_);
    context_ = std::make_unique<cuda::Context>(stream_of(stream));
    hold(constraints);
    mesh_.constraints.slide = call.slide;
    gather_triangles();
    const nb::gil_scoped_release no_gil;
    naming_arguments([&] { plan_.emplace(mesh_, options, context_->stream()); });
  }

  ~DevicePlan() { after_.begin(device_); }
  DevicePlan(const DevicePlan&) = delete;
  DevicePlan& operator=(const DevicePlan&) = delete;

  /// Smooths `points` into `out`: see DevicePoints.
  Outcome smooth(nb::handle points_capsule, nb::handle out_capsule, bool is_new, const nb::object& progress) {
    DevicePoints points(points_capsule, out_capsule, is_new, device_, mesh_.vertex_count);
    const Turn turn(turns_, "the plan");
    Interruption interruption(progress);
    interruption_ = &interruption;
    return points.smoothed(
        *context_, nb::none(), [this](auto* xy, Outcome& outcome) { outcome.smoothing = plan_->smooth(xy); },
        [this] { return plan_->fixed(); });
  }

  std::int64_t vertex_count() const { return mesh_.vertex_count; }
  std::int64_t triangle_count() const { return mesh_.element_count; }
  std::size_t copied_bytes() const { return context_->peak_bytes(); }

 private:
  static std::int32_t checked_count(std::int64_t count, const char* argument) {
    if (count > INT32_MAX) {
      raise_value_error(argument, "more than 2147483647 of them");
    }
    return static_cast<std::int32_t>(count);
  }

  void gather_triangles() {
    if (triangles_.kind() == 'i' && triangles_.item_size() == sizeof(std::int32_t) &&
        triangles_.is_packed(triangles_.extent(1), sizeof(std::int32_t))) {
      mesh_.elements = reinterpret_cast<const std::int32_t*>(triangles_.data());
      return;
    }
    triangle_numbers_ = cuda::DeviceBuffer<std::int32_t>(*context_, triangles_.extent(0) * triangles_.extent(1));
    cuda::gather_integers(*context_, triangles_.rows(mesh_.corners), triangles_.kind() == 'i', triangles_.item_size(),
                          triangle_numbers_.data(), mesh_.corners == 4 ? no_corner : cuda::no_place_in_32_bits);
    mesh_.elements = triangle_numbers_.data();
  }

  void hold(const nb::dict& constraints) {
    if (const nb::handle regions = constraint_of(constraints, "regions"); !regions.is_none()) {
      const DeviceArray labels(regions, "regions");
      labels.require_device(device_);
      if (!is_integer(labels)) {
        labels.raise_type("integers are needed on a CUDA device, not " + labels.type_text());
      }
      require_list(labels, mesh_.element_count, "triangle");
      region_numbers_ = cuda::DeviceBuffer<std::int32_t>(*context_, labels.extent(0));
      cuda::gather_integers(*context_, labels.rows(1), labels.kind() == 'i', labels.item_size(),
                            region_numbers_.data());
      mesh_.constraints.regions = region_numbers_.data();
    }
    hold_vertices(constraints, "fixed", fixed_flags_, mesh_.constraints.fixed);
    hold_vertices(constraints, "other_cells", other_cell_flags_, mesh_.constraints.other_cells);
  }

  /// From a bool for each vertex, or from vertex numbers, which take the way over the host: they are few.
  void hold_vertices(const nb::dict& constraints, const char* argument, cuda::DeviceBuffer<std::uint8_t>& flags,
                     const std::uint8_t*& held) {
    const nb::handle object = constraint_of(constraints, argument);
    if (object.is_none()) {
      return;
    }
    const DeviceArray array(object, argument);
    array.require_device(device_);
    const auto vertices = static_cast<std::size_t>(mesh_.vertex_count);
    flags = cuda::DeviceBuffer<std::uint8_t>(*context_, vertices);
    if (array.kind() == '?') {
      require_list(array, mesh_.vertex_count, "vertex");
      cuda::gather_rows(*context_, array.rows(1), flags.data());
    } else if (is_integer(array) && array.dimensions() == 1) {
      cuda::DeviceBuffer<std::int32_t> numbers(*context_, array.extent(0));
      cuda::gather_integers(*context_, array.rows(1), array.kind() == 'i', array.item_size(), numbers.data());
      std::vector<std::int32_t> on_host(array.extent(0));
      numbers.download(on_host);
      std::vector<std::uint8_t> host_flags(vertices, 0);
      for (const std::int32_t v : on_host) {
        if (v < 0 || v >= mesh_.vertex_count) {
          array.raise_value("vertex " + (v == cuda::no_place_in_32_bits ? "number" : std::to_string(v)) +
                            " is not one of the " + std::to_string(mesh_.vertex_count) + " vertices");
        }
        host_flags[static_cast<std::size_t>(v)] = 1;
      }
      flags.upload(host_flags);
      context_->synchronize();
    } else {
      array.raise_type("bool for each vertex or integers, vertex numbers, are needed, not " + array.type_text() +
                       " of shape " + array.shape_text());
    }
    held = flags.data();
  }

  cuda::DeviceAtEnd after_;  ///< the last to go
  DeviceArray triangles_;
  int device_;
  std::vector<double> sizes_;
  Interruption* interruption_ = nullptr;  ///< of the call that is at work
  cuda::DeviceMesh mesh_;
  std::unique_ptr<cuda::Context> context_;
  cuda::DeviceBuffer<std::int32_t> triangle_numbers_;
  cuda::DeviceBuffer<std::int32_t> region_numbers_;
  cuda::DeviceBuffer<std::uint8_t> fixed_flags_;
  cuda::DeviceBuffer<std::uint8_t> other_cell_flags_;
  std::optional<cuda::Plan> plan_;
  Turns turns_;
};

/// A new array on a device, of no values yet, that any library takes by DLPack.
nb::ndarray<nb::array_api, nb::device::cuda> new_device_array(std::size_t rows, std::size_t columns, bool is_float32,
                                                              int device) {
  const cuda::DeviceScope scope(device);
  void* memory = nullptr;
  const std::size_t bytes = rows * columns * (is_float32 ? sizeof(float) : sizeof(double));
  TRISMOOTH_CUDA_CHECK(cudaMalloc(&memory, std::max<std::size_t>(bytes, 1)));
  const nb::capsule owner(memory, [](void* gone) noexcept { cudaFree(gone); });
  return {memory,
          {rows, columns},
          owner,
          {},
          is_float32 ? nb::dtype<float>() : nb::dtype<double>(),
          nb::device::cuda::value,
          device};
}

}  // namespace

void bind_device(nb::module_& module) {
  module.attr("has_cuda") = true;
  module.def("new_device_array", &new_device_array, "rows"_a, "columns"_a, "is_float32"_a, "device"_a);
  nb::class_<DevicePlan>(module, "DevicePlan")
      .def(nb::init<nb::handle, std::int64_t, const nb::dict&, std::uintptr_t, nb::handle, const nb::dict&>(),
           "triangles"_a, "vertex_count"_a, "constraints"_a, "stream"_a, "kept"_a, "options"_a, nb::keep_alive<1, 6>())
      .def("smooth", &DevicePlan::smooth, "points"_a, "out"_a, "is_new"_a, "progress"_a.none())
      .def_prop_ro("vertex_count", &DevicePlan::vertex_count)
      .def_prop_ro("triangle_count", &DevicePlan::triangle_count)
      .def_prop_ro("copied_bytes", &DevicePlan::copied_bytes);
  bind_device_moving(module);
}

}  // namespace trismooth::python

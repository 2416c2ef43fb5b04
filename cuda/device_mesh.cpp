// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/device_mesh.h"

#include <algorithm>
#include <future>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "trismooth/base/element_list.h"
#include "trismooth/base/errors.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/base/machine/stopwatch.h"
#include "trismooth/base/mesh_size.h"
#include "trismooth/base/moved_from.h"
#include "trismooth/cuda/device_smoother.h"
#include "trismooth/cuda/devices.h"
#include "trismooth/cuda/host_topology.h"
#include "trismooth/cuda/host_untangling.h"
#include "trismooth/cuda/memory_need.h"
#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/primitives/gather_bytes.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/runtime/device_pointer.h"
#include "trismooth/cuda/slide/sliding_options.h"
#include "trismooth/cuda/topology/device_topology.h"
#include "trismooth/cuda/uploaded_rings.h"
#include "trismooth/smoothing/backend_choice.h"
#include "trismooth/smoothing/limited.h"

namespace trismooth::cuda {

namespace {

/// Calls check(pointer, count, alignment, name) for each array of the mesh that is there, and for those that must be.
template <class Check>
void for_arrays(const DeviceMesh& mesh, const Check& check) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count);
  const auto elements = static_cast<std::size_t>(mesh.element_count);
  const DeviceConstraints& held = mesh.constraints;
  check(mesh.elements, static_cast<std::size_t>(mesh.corners) * elements, alignof(std::int32_t),
        "DeviceMesh::elements");
  check(held.fixed_ids, static_cast<std::size_t>(held.fixed_id_count), alignof(std::int32_t),
        "DeviceConstraints::fixed_ids");
  check(held.fixed, held.fixed == nullptr ? 0 : vertices, 1, "DeviceConstraints::fixed");
  check(held.other_cells, held.other_cells == nullptr ? 0 : vertices, 1, "DeviceConstraints::other_cells");
  check(held.regions, held.regions == nullptr ? 0 : elements, alignof(std::int32_t), "DeviceConstraints::regions");
}

/// Kernels read and write a point at once.
template <class T>
void require_points(const T* xy, std::int32_t vertex_count) {
  require_aligned(xy, static_cast<std::size_t>(std::max(vertex_count, 0)), sizeof(Point2<T>), "xy");
}

}  // namespace

class Plan::Implementation {
 public:
  Implementation(const DeviceMesh& mesh, SmoothingOptions options, cudaStream_t stream)
      : vertex_count_(mesh.vertex_count),
        options_(std::move(options)),
        context_(stream),
        topology_(find_topology(mesh)),
        slide_(mesh.constraints.slide),
        near_(slide_.along == Slide::off ? NearLines{} : topology_->near_lines(mesh.constraints.regions)),
        slidable_(find_meanwhile(near_, slide_)),
        extent_(context_) {}

  SmoothingResult smooth(double* xy, Storage storage) {
    require_points(xy, vertex_count_);
    require_on_device(xy, static_cast<std::size_t>(vertex_count_), "xy");
    return smooth_stored(reinterpret_cast<Point2<double>*>(xy), storage);
  }

  SmoothingResult smooth(float* xy) {
    require_points(xy, vertex_count_);
    require_on_device(xy, static_cast<std::size_t>(vertex_count_), "xy");
    DeviceBuffer<Point2<double>> stored(context_, static_cast<std::size_t>(vertex_count_));
    widen_coordinates(context_, xy, vertex_count_, stored.data());
    SmoothingResult result = smooth_stored(stored.data(), Storage::float32);
    narrow_coordinates(context_, stored.data(), vertex_count_, xy);
    context_.synchronize();
    return result;
  }

  const SmoothingOptions& options() const { return options_; }

  std::vector<std::uint8_t> fixed() const {
    return download(context_, topology_->fixed(), static_cast<std::size_t>(vertex_count_));
  }

 private:
  std::unique_ptr<MeshTopology> find_topology(const DeviceMesh& mesh) {
    const std::int32_t* triangles = mesh.elements;
    if (mesh.corners == 4) {
      static_assert(sizeof(MixedElement) == 4 * sizeof(std::int32_t));
      const auto count = static_cast<std::size_t>(mesh.element_count);
      auto listed = download(context_, reinterpret_cast<const MixedElement*>(mesh.elements), count);
      OwnElements converted;
      const ElementList elements = as_triangles_where_all_are(listed, converted);
      if (!elements.are_triangles()) {
        require_quadrilaterals(options_);
        require_room(mesh, 4);
        return std::make_unique<HostTopology>(context_, mesh.vertex_count, mesh.elements, std::move(listed),
                                              mesh.constraints, options_.threads);
      }
      triangles_ = DeviceBuffer<Triangle>(context_, elements.triangles());
      triangles = reinterpret_cast<const std::int32_t*>(triangles_.data());
    }
    require_room(mesh, 3);
    return std::make_unique<DeviceTopology>(context_, mesh.vertex_count, mesh.element_count, triangles,
                                            mesh.constraints, neighbour_search(options_.execution));
  }

  /// `corners`: of an element at most.
  void require_room(const DeviceMesh& mesh, std::int64_t corners) const {
    const MeshSize size{mesh.vertex_count, mesh.vertex_count, corners * mesh.element_count, corners == 4};
    require_memory(memory_need(size, options_) + topology_memory_need(mesh.vertex_count, mesh.element_count));
  }

  /// The device has other work while the host looks for what may slide.
  static std::shared_future<Slidable> find_meanwhile(const NearLines& near, const Sliding& slide) {
    if (slide.along == Slide::off) {
      return std::async(std::launch::deferred, [] { return Slidable{}; });
    }
    return std::async([&near, &slide] { return find_slidable(near, slide); });
  }
  const Slidable& slidable() const { return slidable_.get(); }

  SmoothingResult smooth_stored(Point2<double>* stored, Storage storage) {
    const Stopwatch watch;
    double fixed_quotient = std::numeric_limits<double>::infinity();
    prepare(stored, fixed_quotient);
    if (options_.aims_at_sizes()) {
      smoother_->read_sizes(fixed());
    }
    const double preparing_ms = watch.milliseconds();
    const bool is_tangled = options_.untangles() && smoother_->is_tangled(stored, extent_.frame());
    const bool slides_alone = slidable().any() && !smoother_->has_free_vertices();
    const bool goes_to_host = is_tangled || slides_alone;
    SmoothingResult result =
        goes_to_host ? smooth_on_host(stored, storage) : smooth_here(stored, storage, fixed_quotient);
    if (goes_to_host && !is_tangled) {
      result.backend_note = "all vertices are held to lines, on which the CPU moves them";
    }
    if (slidable().is_wanted() && !result.sliding) {
      result.sliding.emplace();
    }
    if (options_.untangles() && !goes_to_host) {
      result.untangling = fixed_quotient > 0 && options_.guard ? UntanglingResult{} : not_tangled(stored);
    }
    result.layers = layers_;
    result.quadrilaterals = topology_->quadrilaterals();
    result.backend_note = joined_notes(std::string(topology_->note()), result.backend_note);
    result.timings.prepare = preparing_ms;
    result.device_memory_bytes = static_cast<std::int64_t>(context_.peak_bytes());
    return result;
  }

  SmoothingResult smooth_here(Point2<double>* stored, Storage storage, double fixed_quotient) {
    SmoothingResult result = smoother_->smooth(stored, extent_.frame(), storage, fixed_quotient);
    const InvalidCounts invalid = topology_->invalid_elements(stored, extent_.frame());
    result.inverted = invalid.inverted;
    result.degenerate = invalid.degenerate;
    return result;
  }

  /// The host's part of the work.
  HostUntangling host_untangling() { return {fixed(), topology_->elements().list(), options_, slidable()}; }

  /// Counts what is inverted all the same: elements without a free vertex, or those that no guard has watched.
  UntanglingResult not_tangled(const Point2<double>* stored) {
    const auto points = download(context_, stored, static_cast<std::size_t>(vertex_count_));
    const auto reversed = download(context_, topology_->reversed(), topology_->element_count());
    return host_untangling().not_tangled(reversed, points, download(context_, extent_.frame()));
  }

  /// Takes the mesh to the host and back.
  SmoothingResult smooth_on_host(Point2<double>* stored, Storage storage) {
    const auto vertices = static_cast<std::size_t>(vertex_count_);
    std::vector<Point2<double>> points = download(context_, static_cast<const Point2<double>*>(stored), vertices);
    SmoothingResult result = host_untangling().smooth(points, storage, download(context_, extent_.frame()));
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(stored, points.data(), vertices * sizeof(Point2<double>),
                                         cudaMemcpyHostToDevice, context_.stream()));
    context_.synchronize();
    return result;
  }

  /// Finds the local frame, orients the mesh by its coordinates, and packs it where that is new.
  void prepare(const Point2<double>* stored, double& fixed_quotient) {
    extent_.find(stored, vertex_count_, topology_->fixed());
    DeviceBuffer<Point2<double>> local(context_, static_cast<std::size_t>(vertex_count_));
    enter_frame(context_, stored, vertex_count_, extent_.frame(), local.data());
    if (topology_->orient(local.data())) {
      smoother_.reset();
    }
    // Not asked before all that waits for the device anyway. A mesh that is refused may have another orientation.
    if (const std::int32_t vertex = extent_.extent().first_not_finite; vertex >= 0) {
      throw MeshError("vertex " + std::to_string(vertex) + " has a coordinate that is not finite");
    }
    CallLimit::look();
    if (!has_found_layers_) {
      find_layers(local.data());
      has_found_layers_ = true;
    }
    CallLimit::look();
    if (options_.measures_shape() || options_.untangles()) {
      fixed_quotient = topology_->smallest_fixed_quotient(local.data());
    }
    if (smoother_ == nullptr) {
      smoother_ = make_device_smoother(context_, topology_->rings(), std::move(local), options_);
      if (slidable().any() && smoother_->has_free_vertices()) {
        smoother_->slide_on(slidable(), reversed_of_slidable());
      }
      context_.synchronize();
    }
  }

  void find_layers(const Point2<double>* local) {
    std::vector<std::int32_t> held;
    const bool slides = slide_.along != Slide::off;
    layers_ = topology_->hold_layers(local, options_.used_layers(), slides, held);
    if (!held.empty() && slides) {
      slidable_.wait();
      hold_otherwise(near_, held);
      slidable_ = find_meanwhile(near_, slide_);
    }
  }

  std::vector<std::uint8_t> reversed_of_slidable() {
    const DeviceBuffer<std::int32_t> numbers(context_, slidable().element_numbers);
    return gather_bytes(context_, topology_->reversed(), numbers);
  }

  std::int32_t vertex_count_;
  SmoothingOptions options_;
  Context context_;
  DeviceBuffer<Triangle> triangles_;  ///< where the caller has triangles alone in a list of four numbers each
  std::unique_ptr<MeshTopology> topology_;
  Sliding slide_;   ///< it names no vertices
  NearLines near_;  ///< what it takes to find what may slide
  std::shared_future<Slidable> slidable_;
  LayersResult layers_;
  bool has_found_layers_ = false;
  ExtentFinder extent_;
  std::unique_ptr<DeviceSmoother> smoother_;
};

Plan::Plan(const DeviceMesh& mesh, const SmoothingOptions& options, cudaStream_t stream) {
  options.validate();
  if (options.proposal) {
    throw std::invalid_argument("a proposal is a function of the host: smooth() on the CPU takes it");
  }
  if (mesh.corners != 3 && mesh.corners != 4) {
    throw std::invalid_argument("DeviceMesh::corners is " + std::to_string(mesh.corners) +
                                "; expected 3, or 4 with quadrilaterals");
  }
  check_mesh_size(mesh.vertex_count, mesh.element_count, mesh.corners);
  const Sliding& slide = mesh.constraints.slide;
  slide.validate();
  if (slide.names_vertices()) {
    throw std::invalid_argument("DeviceConstraints::slide has lines or links, which are for meshes of the host");
  }
  if (slide.along != Slide::off) {
    require_sliding(options);
    if (!can_slide(options)) {
      throw std::invalid_argument("target_quality and record_min_shape are not to be had on a device with slide");
    }
  }
  if (mesh.constraints.fixed_id_count < 0) {
    throw std::invalid_argument("DeviceConstraints::fixed_id_count is negative");
  }
  for_arrays(mesh, &require_aligned);
  require_device();
  for_arrays(mesh, [](const void* array, std::size_t count, std::size_t /*alignment*/, std::string_view name) {
    require_on_device(array, count, name);
  });
  implementation_ = planned(options, [&] { return std::make_unique<Implementation>(mesh, options, stream); });
}

Plan::Plan(Plan&&) noexcept = default;
Plan& Plan::operator=(Plan&&) noexcept = default;
Plan::~Plan() = default;

SmoothingResult Plan::smooth(double* xy, Storage storage) {
  Implementation& plan = not_moved_from(implementation_);
  return limited(plan.options(), "cuda", [&] { return plan.smooth(xy, storage); });
}

SmoothingResult Plan::smooth(float* xy) {
  Implementation& plan = not_moved_from(implementation_);
  return limited(plan.options(), "cuda", [&] { return plan.smooth(xy); });
}

std::vector<std::uint8_t> Plan::fixed() const {
  return not_moved_from(implementation_).fixed();
}

SmoothingResult smooth(const DeviceMesh& mesh, double* xy, const SmoothingOptions& options, cudaStream_t stream) {
  require_points(xy, mesh.vertex_count);  // before all the work of the analysis
  options.validate();
  return limited(options, "cuda", [&] { return Plan(mesh, options, stream).smooth(xy); });
}

SmoothingResult smooth(const DeviceMesh& mesh, float* xy, const SmoothingOptions& options, cudaStream_t stream) {
  require_points(xy, mesh.vertex_count);
  options.validate();
  return limited(options, "cuda", [&] { return Plan(mesh, options, stream).smooth(xy); });
}

}  // namespace trismooth::cuda

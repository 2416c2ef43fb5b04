// SPDX-License-Identifier: BSD-3-Clause
#include "trismooth/cuda/device_follower.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <future>
#include <limits>
#include <string>
#include <utility>

#include "trismooth/base/local_points.h"
#include "trismooth/base/machine/call_limit.h"
#include "trismooth/cuda/moving/moved_points.h"
#include "trismooth/cuda/packing/coordinates.h"
#include "trismooth/cuda/primitives/bounding_box.h"
#include "trismooth/cuda/primitives/device_algorithms.h"
#include "trismooth/cuda/runtime/check.h"
#include "trismooth/cuda/topology/element_quotients.h"
#include "trismooth/cuda/uploaded_rings.h"
#include "trismooth/smoothing/errors.h"
#include "trismooth/smoothing/moving/carry.h"

namespace trismooth::cuda {

DeviceFollower::DeviceFollower(const MeshAtRest& mesh, const MeshRings& rings, const SmoothingOptions& options,
                               std::optional<cudaStream_t> stream)
    : mesh_(mesh),
      options_(options),
      context_(stream ? Context(*stream) : Context()),
      copier_(context_, options.threads),
      count_(static_cast<std::int32_t>(mesh.points().size())),
      triangles_(copier_.uploaded(mesh.elements().triangles())),
      reversed_(copier_.uploaded(std::span<const std::uint8_t>(mesh.reversed()))),
      held_(copier_.uploaded(std::span<const std::uint8_t>(mesh.held()))),
      held_alone_(context_, mesh.held_alone()),
      fixed_(copier_.uploaded(std::span<const std::uint8_t>(rings.fixed))),
      rest_(copier_.uploaded(std::span<const Point2<double>>(mesh.points()))),
      rest_local_(copier_.uploaded(std::span<const Point2<double>>(mesh.local().points))),
      previous_(copier_.uploaded(std::span<const Point2<double>>(mesh.points()))),
      stored_(context_, mesh.points().size()),
      now_(context_, mesh.points().size()),
      local_(context_, mesh.points().size()),
      was_(context_, mesh.points().size()),
      carrier_(context_, mesh.carrier()),
      extent_of_held_(context_),
      extent_(context_) {
  require_room_for(rings.rings, options);
  smoother_ = make_device_smoother(context_, uploaded(copier_, rings.rings),
                                   copier_.uploaded(std::span<const Point2<double>>(mesh.local().points)), options);
  if (options.untangles()) {
    untangling_.emplace(rings.fixed, mesh.elements(), options);
    untangling_->aim_at(mesh.points(), mesh.local().frame);
  }
  extent_.find(rest_.data(), count_, held_.data());
  smoother_->aim_at(rest_.data(), extent_.frame(), mesh.local().frame.exponent);
  last_ = {mesh.local().frame, mesh.of_held(mesh.points())};
  context_.synchronize();
}

void DeviceFollower::follow(std::span<Point2<double>> points, Storage storage, MovingStart start,
                            FollowResult& result) {
  copier_.upload(stored_, std::span<const Point2<double>>(points));
  follow(storage, start, result);
  if (result.smoothing.inverted >= 0) {
    copier_.download(points, previous_);
  }
}

void DeviceFollower::follow_on_device(double* xy, Storage storage, MovingStart start, FollowResult& result) {
  const std::size_t bytes = stored_.size() * sizeof(Point2<double>);
  TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(stored_.data(), xy, bytes, cudaMemcpyDeviceToDevice, context_.stream()));
  follow(storage, start, result);
  if (result.smoothing.inverted >= 0) {
    TRISMOOTH_CUDA_CHECK(cudaMemcpyAsync(xy, previous_.data(), bytes, cudaMemcpyDeviceToDevice, context_.stream()));
    context_.synchronize();
  }
}

void DeviceFollower::follow_on_device(float* xy, Storage storage, MovingStart start, FollowResult& result) {
  widen_coordinates(context_, xy, count_, stored_.data());
  follow(storage, start, result);
  if (result.smoothing.inverted >= 0) {
    narrow_coordinates(context_, previous_.data(), count_, xy);
    context_.synchronize();
  }
}

void DeviceFollower::go_on_from(std::vector<Point2<double>> points) {
  copier_.upload(previous_, std::span<const Point2<double>>(points));
  last_ = {local_frame_of_cells(points, mesh_.held()), mesh_.of_held(points)};
  context_.synchronize();
}

std::vector<Point2<double>> DeviceFollower::points() const {
  return download(context_, previous_.data(), previous_.size());
}

TriangleList DeviceFollower::triangles() const {
  return {triangles_.data()->data(), static_cast<std::int32_t>(triangles_.size())};
}

void DeviceFollower::follow(Storage storage, MovingStart start, FollowResult& result) {
  std::vector<Point2<double>> of_held;
  carry(storage, start, of_held, result);
  extent_.find(now_.data(), count_, held_.data());
  smooth(storage, result.smoothing);
  if (result.smoothing.inverted < 0) {
    return;
  }
  look_at(result);
  std::swap(previous_, now_);
  extent_.find(previous_.data(), count_, held_.data());
  before_last_ = std::exchange(last_, {extent_.extent().frame, std::move(of_held)});
}

void DeviceFollower::take_back() {
  std::swap(previous_, now_);
  std::swap(last_, before_last_);
}

void DeviceFollower::carry(Storage storage, MovingStart start, std::vector<Point2<double>>& of_held,
                           FollowResult& result) {
  // Without the free vertices carried along there is no mesh to end with.
  const CallLimit patient(std::numeric_limits<double>::infinity(), *CallLimit::current());
  extent_of_held_.find(stored_.data(), count_, held_alone_.data());
  of_held = points_of_vertices(context_, carrier_.held(), stored_.data());
  const Extent extent = extent_of_held_.extent();
  if (extent.first_not_finite >= 0) {
    throw MeshError("vertex " + std::to_string(extent.first_not_finite) + " has a coordinate that is not finite");
  }
  const LocalFrame frame = extent.frame;
  std::vector<Point2<double>> held_now(of_held.size());
  std::ranges::transform(of_held, held_now.begin(), [&](Point2<double> p) { return frame.enter(p); });
  // The device has other work meanwhile.
  std::future<void> crossings = std::async(std::launch::async, [&] { mesh_.find_crossings(held_now, result); });
  const bool from_rest = start == MovingStart::reference;
  const DeviceBuffer<Point2<double>>& from = from_rest ? rest_ : previous_;
  const LocalFrame from_frame = from_rest ? mesh_.local().frame : last_.frame;
  const int power = from_frame.exponent - frame.exponent;
  std::vector<Point2<double>> held_from = from_rest ? mesh_.of_held(mesh_.points()) : last_.of_held;
  std::ranges::transform(held_from, held_from.begin(),
                         [&](Point2<double> p) { return rescaled(from_frame.enter(p), power); });
  const HeldMotion motion = mesh_.carrier().motion_of_held(held_from, held_now);
  enter_rescaled(context_, from.data(), count_, from_frame, power, was_.data());
  enter_rescaled(context_, stored_.data(), count_, frame, 0, local_.data());
  carrier_.carry(motion, was_.data(), local_.data());
  leave_carried(context_, carrier_.carried(), held_.data(), stored_.data(), from.data(), local_.data(), frame, storage,
                now_);
  crossings.get();
}

void DeviceFollower::smooth(Storage storage, SmoothingResult& result) {
  double fixed_quotient = std::numeric_limits<double>::infinity();
  if (options_.measures_shape() || options_.untangles()) {
    enter_frame(context_, now_.data(), count_, extent_.frame(), local_.data());
    fixed_quotient = smallest_fixed_quotient(context_, triangles(), local_.data(), reversed_.data(), fixed_.data());
  }
  if (untangling_ && smoother_->is_tangled(now_.data(), extent_.frame())) {
    std::vector<Point2<double>> points = download(context_, now_.data(), now_.size());
    result = untangling_->smooth(points, storage, extent_.extent().frame);
    copier_.upload(now_, std::span<const Point2<double>>(points));
    return;
  }
  result = smoother_->smooth(now_.data(), extent_.frame(), storage, fixed_quotient);
  if (untangling_) {
    result.untangling = fixed_quotient > 0 && options_.guard
                            ? UntanglingResult{}
                            : untangling_->not_tangled(mesh_.reversed(), download(context_, now_.data(), now_.size()),
                                                       extent_.extent().frame);
  }
}

void DeviceFollower::look_at(FollowResult& result) {
  const LocalFrame frame = extent_.extent().frame;
  enter_frame(context_, now_.data(), count_, extent_.frame(), local_.data());
  const InvalidCounts invalid = invalid_elements(context_, triangles(), now_.data(), extent_.frame(), reversed_.data());
  result.smoothing.inverted = invalid.inverted;
  result.smoothing.degenerate = invalid.degenerate;
  mesh_.list_overlaps(
      overlapping_vertices(context_, triangles(), reversed_.data(), held_.data(), local_.data(), count_), result);
  if (invalid.inverted + invalid.degenerate > 0) {
    mesh_.list_invalid(download(context_, local_.data(), local_.size()), result);
  }
  double sum = 0;
  const RelativeShapes shapes =
      relative_shapes(context_, triangles(), reversed_.data(), held_.data(), rest_local_.data(), local_.data(), sum);
  tell(shapes, sum, result);
  result.largest_move = largest_move(context_, previous_.data(), now_.data(), count_, frame.exponent);
}

}  // namespace trismooth::cuda
